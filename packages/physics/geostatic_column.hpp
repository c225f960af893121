#pragma once

#include <functional>
#include <optional>

#include "physics/soil.hpp"

namespace mudline {

/// Total vertical stress and pressure of the water at rest under horizontal layers, compression positive. Layers are
/// given by mesh region and by the tops of its materials, each with its pore fluid. Where pore pressures are in excess
/// of water at rest, so is the stress. The vertical is where gravity points, and heights are Soil::height. Where the
/// void ratio of a layer comes from its law, density and stress depend on each other: d sigma_v/d depth = rho(sigma_v)
/// g is integrated downwards.
class GeostaticColumn {
 public:
  /// Finds the layers. `gravity` [m/s2] downwards; without a water level [m] the soil is dry. InputError where regions
  /// of different density, of soil or pore fluid, lie side by side. Collective.
  GeostaticColumn(const Soil& soil, double gravity, std::optional<double> water_level, const Section& section);
  /// Density [kg/m3] of a material at a height [m] under a total vertical stress [Pa], with the water at that height.
  using Density = std::function<double(const SoilMaterial& material, double y, double total)>;
  /// Integrates the vertical stress. surcharge: stress on the top [Pa] besides that of the water above it. `density` is
  /// called only for layers whose density varies with the depth.
  void weigh(double surcharge, const Density& density);

  double total_stress(double y) const;
  /// Pressure [Pa] of water at rest; negative (a suction) above the water level. Water above the top has the density of
  /// the uppermost layer's fluid.
  double pore_pressure(double y) const;

 private:
  struct Layer {
    double bottom, top;
    double uplift;  // [kg/m3] reduction of the density by uplift where pore pressures are in excess of water at rest
    double fluid_density;  // [kg/m3] 0 where there is no pore pressure
    const SoilMaterial* material;
    bool varies() const { return material->void_ratio_varies() || material->retention.acts(); }
    double constant_density() const { return material->density(material->initial_porosity()) - uplift; }
  };
  struct Station {
    double y, stress, slope;  // [m] [Pa] [Pa/m] d stress/d depth just below
  };
  /// Weight of the fluid between the bottom and a height, per area [Pa].
  double fluid_weight(double y) const;

  double gravity_;
  std::optional<double> water_level_;
  std::vector<Layer> layers_;      // from the top
  std::vector<Station> stations_;  // from the top; linear or cubic between two
};

}  // namespace mudline
