#pragma once

#include <functional>

#include "physics/soil.hpp"

namespace mudline {

/// Total vertical stress (in excess of water at rest where the pore pressures are) under horizontal layers by mesh region; compression positive. Where the void ratio of a layer comes
/// from its law, density and stress depend on each other: d sigma_v/d depth = rho(sigma_v) g is integrated downwards.
class GeostaticColumn {
 public:
  /// Finds the layers. InputError where regions of different density stand side by side.
  GeostaticColumn(const Soil& soil, const Section& section);
  /// [kg/m3] of a material at a height under a total vertical stress [Pa]
  using Density = std::function<double(const SoilMaterial& material, double y, double total)>;
  /// top_stress: total, on the top [Pa]. `density` is asked for the layers only whose law decides.
  void weigh(double top_stress, double gravity, const Density& density);

  double top() const { return layers_.front().top; }
  double total_stress(double y) const;

 private:
  struct Layer {
    double bottom, top;
    double uplift;  // [kg/m3] density that the water at rest takes away where pore pressures are in excess of it
    const SoilMaterial* material;
    double constant_density() const { return material->density(material->initial_porosity()) - uplift; }
  };
  struct Station {
    double y, stress, slope;  // [m] [Pa] [Pa/m] d stress/d depth just below
  };
  std::vector<Layer> layers_;      // from the top
  std::vector<Station> stations_;  // from the top; linear or cubic between two
};

}  // namespace mudline
