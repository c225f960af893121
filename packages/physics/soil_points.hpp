#pragma once

#include <cmath>

#include "physics/soil.hpp"
#include "tensor/midpoint_rule.hpp"

namespace mudline {

/// Properties of a soil point that matter for waves and consolidation.
struct SoilFigures {
  double shear, modulus;  // [Pa] G, drained constrained modulus
  double wave;            // [m/s] speed of the undrained compression wave; infinite without density
  double density;         // [kg/m3]
  double conductivity;    // [m/s] hydraulic; 0 without pore fluid, like `consolidation`
  double consolidation;   // [m2/s] c_v
};

/// The points of one block in one state, each with its own material; for host code.
class SoilPoints {
 public:
  SoilPoints(const Soil& soil, const SoilBlock& block, const State& state)
      : materials_(&soil.materials),
        porous_(block.porous()),
        which_(soil.which(block, state)),
        stress_(state.arrays[block.stress]),
        void_ratio_(state.arrays[block.void_ratio]),
        law_(state.arrays[block.law]),
        ratios_(block.permeability >= 0 ? state.arrays[block.permeability] : PointView()),
        numbers_(block.conductivity >= 0 ? state.arrays[block.conductivity] : PointView()) {}

  /// Number of a point's material in Soil::materials.
  int material_number(int row) const { return static_cast<int>(which_(row, 0)); }
  const SoilMaterial& material(int row) const { return *(*materials_)[material_number(row)]; }
  const double* stress(int row) const { return &stress_(row, 0); }
  double void_ratio(int row) const { return void_ratio_(row, 0); }
  double porosity(int row) const { return void_ratio(row) / (1 + void_ratio(row)); }
  /// The state of the law.
  double* law(int row) const { return law_.data() + row * law_.extent(1); }

  ElasticModuli moduli(int row) const { return material(row).skeleton->moduli(stress(row), void_ratio(row), law(row)); }
  /// Drained constrained modulus [Pa].
  double constrained_modulus(int row) const { return constrained(moduli(row)); }
  SoilFigures figures(int row) const {
    const ElasticModuli m = moduli(row);
    SoilFigures f{m.shear, constrained(m), 0, density(row), 0, 0};
    const double alpha = material(row).biot_coefficient, held = porous_ ? storage(row) : 0;
    f.wave = std::sqrt((held > 0 ? f.modulus + alpha * alpha / held : f.modulus) / f.density);
    if (!porous_) return f;
    f.conductivity = conductivity(row);
    f.consolidation = f.conductivity * f.modulus / material(row).fluid->unit_weight();
    return f;
  }
  SoilState soil_state(int row) const {
    return material(row).skeleton->soil_state(stress(row), void_ratio(row), law(row));
  }
  double density(int row) const { return material(row).density(porosity(row)); }  // [kg/m3]
  double storage(int row) const { return material(row).storage(porosity(row)); }  // 1/Q [1/Pa]
  /// Hydraulic conductivity of saturated soil [m/s].
  double conductivity(int row) const {
    const Conductivity law = material(row).permeability->in_kernels();
    const bool own = numbers_.extent(0) > 0;
    return (own ? law.with_numbers(&numbers_(row, 0)) : law)(void_ratio(row), void_ratio_(row, 1)).k;
  }
  /// Mobility k/gamma_w [m2/(Pa s)] of saturated soil, without the ratios of directions.
  double mobility(int row) const { return conductivity(row) / material(row).fluid->unit_weight(); }
  /// a . r b with the tensor r of PermeabilityRatios. a, b: `dimension` components.
  double along_ratios(int row, const double* a, const double* b, int dimension) const {
    double sum = 0;
    for (int i = 0; i < dimension; ++i) {
      if (ratios_.extent(0) == 0) sum += a[i] * b[i];
      if (ratios_.extent(0) > 0)
        for (int j = 0; j < dimension; ++j) sum += a[i] * ratios_(row, six(i, j)) * b[j];
    }
    return sum;
  }

 private:
  static double constrained(const ElasticModuli& m) { return m.bulk + 4.0 / 3 * m.shear; }

  const std::vector<std::shared_ptr<const SoilMaterial>>* materials_;
  bool porous_;
  PointView which_, stress_, void_ratio_, law_, ratios_, numbers_;
};

}  // namespace mudline
