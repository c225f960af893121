#pragma once

#include "physics/soil.hpp"

namespace mudline {

/// Content of the soil of the whole mesh in one state.
struct Inventory {
  double momentum[axis_names.size()] = {};  // [N s]
  double kinetic = 0;                       // [J]
  double solid = 0;                         // mass of the grains [kg]
  double water = 0;                         // volume of pore water, at zero pressure [m3]
  double pore_volume = 0;                   // [m3]
  std::vector<double> grains;               // mass of the grains of each material, by Soil::materials [kg]
  double compression = 0;  // [m3] water minus pore volume; summed separately, because it is smaller than their rounding
};

/// The content of a state. Axisymmetric: of the whole circumference; plane strain: per metre. Collective.
Inventory take_inventory(const Soil& soil, const State& state);

}  // namespace mudline
