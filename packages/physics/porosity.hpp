#pragma once

#include <cmath>

#include "materials/pore_volume.hpp"
#include "physics/element.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// The soil's mixture as kernels see it: porosity, density and storage follow the deformation of the step.
struct Mixture {
  double alpha, grain_density, fluid_density, fluid_compliance, grain_compliance;

  explicit Mixture(const SoilMaterial& m)
      : alpha(m.biot_coefficient),
        grain_density(m.grain_density),
        fluid_density(m.fluid ? m.fluid->density() : 0.0),
        fluid_compliance(m.fluid && std::isfinite(m.fluid->bulk_modulus()) ? 1 / m.fluid->bulk_modulus() : 0.0),
        grain_compliance(m.grain_bulk_modulus > 0 ? 1 / m.grain_bulk_modulus : 0.0) {}

  KOKKOS_INLINE_FUNCTION double porosity(double old, double volume_ratio, double dp) const {
    return porosity_after(alpha, old, ::log(volume_ratio), dp * grain_compliance);
  }
  /// d n / d(ln J); d n / dp is this times the grain compliance.
  KOKKOS_INLINE_FUNCTION double porosity_slope(double n) const { return alpha - n; }
  KOKKOS_INLINE_FUNCTION double density(double n) const { return (1 - n) * grain_density + n * fluid_density; }
  /// 1/Q [1/Pa]
  KOKKOS_INLINE_FUNCTION double storage(double n) const {
    return n * fluid_compliance + (alpha - n) * grain_compliance;
  }
};

}  // namespace mudline
