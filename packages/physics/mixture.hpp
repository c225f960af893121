#pragma once

#include <cmath>

#include "framework/point_fields.hpp"
#include "materials/pore_volume.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// The soil's mixture at a point as laws of balance see it: porosity, density and storage follow the deformation of the
/// step. T: double or a dual number.
struct Mixture {
  double alpha, grain_density, fluid_density, fluid_compliance, grain_compliance, grain_expansion, fluid_expansion,
      reference;                     // [degC]
  const Permeability* permeability;  // of saturated soil
  double unit_weight;                // of its fluid [N/m3]

  Mixture() = default;
  Mixture(const Soil& soil, const SoilBlock& b, const SoilMaterial& material)
      : alpha(material.biot_coefficient),
        grain_density(material.grain_density),
        fluid_density(b.porous() ? material.fluid->density() : 0.0),
        fluid_compliance(
            b.porous() && std::isfinite(material.fluid->bulk_modulus()) ? 1 / material.fluid->bulk_modulus() : 0.0),
        grain_compliance(material.grain_bulk_modulus > 0 ? 1 / material.grain_bulk_modulus : 0.0),
        grain_expansion(b.grain_expansion),
        fluid_expansion(soil.water_expansion),
        reference(soil.reference_temperature),
        permeability(material.permeability.get()),
        unit_weight(b.porous() ? material.fluid->unit_weight() : 0.0) {}

  /// After the volume ratio and, in saturated soil, the changes of pore pressure and temperature of the step.
  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION T porosity(double void_ratio, const PointFields<C, S, T>& at) const {
    T grains = 0.0;
    if constexpr (S > 0) grains = at.change[0] * grain_compliance;
    if constexpr (S > 1) grains -= at.change[1] * grain_expansion;
    return porosity_after<T>(alpha, void_ratio / (1 + void_ratio), logarithm(at.volume_ratio), grains);
  }
  /// At a temperature; that of water whatever its pressure.
  template <class T>
  KOKKOS_INLINE_FUNCTION T grain_density_at(const T& temperature) const {
    return grain_density * exponential(-grain_expansion * (temperature - reference));
  }
  template <class T>
  KOKKOS_INLINE_FUNCTION T fluid_density_at(const T& temperature) const {
    return fluid_density * exponential(-fluid_expansion * (temperature - reference));
  }
  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION T density(const T& n, const PointFields<C, S, T>& at) const {
    if constexpr (S > 1)
      return (1.0 - n) * grain_density_at(at.value[1]) + n * fluid_density_at(at.value[1]);
    else
      return (1.0 - n) * grain_density + n * fluid_density;
  }
  /// 1/Q [1/Pa]
  template <class T>
  KOKKOS_INLINE_FUNCTION T storage(const T& n) const {
    return n * fluid_compliance + (alpha - n) * grain_compliance;
  }
};

/// That of every point of a block.
struct Mixtures {
  Kokkos::View<Mixture*> of;  // by number of the material
  PointView which;

  Mixtures(const Soil& soil, const SoilBlock& b, const State& state)
      : of("mixtures", soil.materials.size()), which(soil.which(b, state)) {
    for (int k : b.made_of) of(k) = Mixture(soil, b, *soil.materials[k]);
  }
  KOKKOS_INLINE_FUNCTION const Mixture& operator()(int row) const { return of(static_cast<int>(which(row, 0))); }
};

}  // namespace mudline
