#pragma once

#include "physics/soil.hpp"

namespace mudline {

/// What the soil of the whole mesh holds in one state.
struct Inventory {
  double momentum[axis_names.size()] = {};  // [N s]
  double kinetic = 0;                       // [J]
  double solid = 0;                         // mass of the grains [kg]
  double water = 0;                         // volume of pore water, at zero pressure [m3]
  double pore_volume = 0;                   // [m3]
  std::vector<double> grains;               // those of each material, by Soil::materials [kg]
  double compression = 0;  // [m3] water less pore volume, summed apart from them: it is smaller than their rounding
};

/// Axisymmetric: of the whole circumference; plane strain: per metre. Collective.
Inventory take_inventory(const Soil& soil, const State& state);

}  // namespace mudline
