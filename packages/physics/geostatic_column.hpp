#pragma once

#include <functional>
#include <optional>

#include "physics/soil.hpp"

namespace mudline {

/// Total vertical stress and pressure of the water at rest (stress in excess of it where the pore pressures are) under
/// horizontal layers by mesh region and by the tops of its materials, each with its pore fluid; compression positive.
/// The vertical is where gravity points, and heights are Soil::height. Where the void ratio of a layer comes from its
/// law, density and stress depend on each other: d sigma_v/d depth = rho(sigma_v) g is integrated downwards.
class GeostaticColumn {
 public:
  /// Finds the layers. `gravity` [m/s2] downwards; without a water level [m] the soil is dry. InputError where regions
  /// of different density, of soil or pore fluid, stand side by side. Collective.
  GeostaticColumn(const Soil& soil, double gravity, std::optional<double> water_level, const Section& section);
  /// [kg/m3] of a material at a height under a total vertical stress [Pa]
  using Density = std::function<double(const SoilMaterial& material, double y, double total)>;
  /// surcharge: stress on the top [Pa] beside that of water that stands above it. `density` is asked for the layers
  /// only whose law decides.
  void weigh(double surcharge, const Density& density);

  double total_stress(double y) const;
  /// Pressure [Pa] of water at rest: negative, a suction, above the water level, since all soil is saturated. Water
  /// above the top is the uppermost layer's.
  double pore_pressure(double y) const;

 private:
  struct Layer {
    double bottom, top;
    double uplift;         // [kg/m3] density that the water at rest takes away where pore pressures are in excess of it
    double fluid_density;  // [kg/m3] 0 where no pore pressure carries the fluid
    const SoilMaterial* material;
    double constant_density() const { return material->density(material->initial_porosity()) - uplift; }
  };
  struct Station {
    double y, stress, slope;  // [m] [Pa] [Pa/m] d stress/d depth just below
  };
  /// Of the fluid between the bottom and a height [Pa].
  double fluid_weight(double y) const;

  double gravity_;
  std::optional<double> water_level_;
  std::vector<Layer> layers_;      // from the top
  std::vector<Station> stations_;  // from the top; linear or cubic between two
};

}  // namespace mudline
