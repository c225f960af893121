#pragma once

#include "physics/soil.hpp"

namespace mudline {

/// The points of one block in one state, each with its own material; for what runs on the host.
class SoilPoints {
 public:
  SoilPoints(const Soil& soil, const SoilBlock& block, const State& state)
      : materials_(&soil.materials),
        which_(soil.which(block, state)),
        stress_(state.arrays[block.stress]),
        void_ratio_(state.arrays[block.void_ratio]),
        law_(state.arrays[block.law]) {}

  const SoilMaterial& material(int row) const { return *(*materials_)[static_cast<int>(which_(row, 0))]; }
  const double* stress(int row) const { return &stress_(row, 0); }
  double void_ratio(int row) const { return void_ratio_(row, 0); }
  double porosity(int row) const { return void_ratio(row) / (1 + void_ratio(row)); }
  /// The state of the law.
  double* law(int row) const { return law_.data() + row * law_.extent(1); }

  ElasticModuli moduli(int row) const { return material(row).skeleton->moduli(stress(row), void_ratio(row), law(row)); }
  SoilState soil_state(int row) const {
    return material(row).skeleton->soil_state(stress(row), void_ratio(row), law(row));
  }
  double density(int row) const { return material(row).density(porosity(row)); }  // [kg/m3]
  double storage(int row) const { return material(row).storage(porosity(row)); }  // 1/Q [1/Pa]
  /// [m/s] of saturated soil
  double conductivity(int row) const {
    return material(row).permeability->conductivity(void_ratio(row), void_ratio_(row, 1)).k;
  }

 private:
  const std::vector<std::shared_ptr<const SoilMaterial>>* materials_;
  PointView which_, stress_, void_ratio_, law_;
};

}  // namespace mudline
