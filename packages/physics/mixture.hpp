#pragma once

#include <cmath>

#include "framework/point_fields.hpp"
#include "materials/pore_volume.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// The soil's mixture as laws of balance see it: porosity, density and storage follow the deformation of the step. T:
/// double or a dual number.
struct Mixture {
  double alpha, grain_density, fluid_density, fluid_compliance, grain_compliance;

  explicit Mixture(const SoilMaterial& m)
      : alpha(m.biot_coefficient),
        grain_density(m.grain_density),
        fluid_density(m.fluid ? m.fluid->density() : 0.0),
        fluid_compliance(m.fluid && std::isfinite(m.fluid->bulk_modulus()) ? 1 / m.fluid->bulk_modulus() : 0.0),
        grain_compliance(m.grain_bulk_modulus > 0 ? 1 / m.grain_bulk_modulus : 0.0) {}

  /// After the volume ratio and, in saturated soil, the change of pore pressure of the step.
  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION T porosity(double void_ratio, const PointFields<C, S, T>& at) const {
    T grains = 0.0;
    if constexpr (S > 0) grains = at.change[0] * grain_compliance;
    return porosity_after<T>(alpha, void_ratio / (1 + void_ratio), logarithm(at.volume_ratio), grains);
  }
  template <class T>
  KOKKOS_INLINE_FUNCTION T density(const T& n) const {
    return (1.0 - n) * grain_density + n * fluid_density;
  }
  /// 1/Q [1/Pa]
  template <class T>
  KOKKOS_INLINE_FUNCTION T storage(const T& n) const {
    return n * fluid_compliance + (alpha - n) * grain_compliance;
  }
};

}  // namespace mudline
