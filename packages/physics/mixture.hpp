#pragma once

#include <cmath>

#include "framework/point_fields.hpp"
#include "materials/pore_volume.hpp"
#include "materials/retention.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// Index of a field of the model among the scalar fields of a block; -1 where it is not among them. The index is found
/// by field because the pore pressure may be followed by a temperature or by a plugin's own field.
inline int place_of_scalar(const FieldBlock& block, int field) {
  for (int k = 0; k < block.scalars; ++k)
    if (field >= 0 && block.scalar[k] == field) return k;
  return -1;
}

/// The mixture of grains and fluid at a point for balance laws: porosity, density and storage follow the deformation of
/// the step. T: double or a dual number.
struct Mixture {
  double alpha, grain_density, fluid_density, fluid_compliance, grain_compliance, grain_expansion, fluid_expansion,
      reference;              // [degC]
  Conductivity conductivity;  // of saturated soil
  double unit_weight;         // unit weight of its fluid [N/m3]
  Retention retention;
  bool viscosity_follows;     // whether the viscosity of the water depends on the temperature
  int pressure, temperature;  // indices among the scalar fields of the block that is looped over; -1: absent

  Mixture() = default;
  /// The mixture of material `number` in block b. `fields`: the block that is looped over, the soil's own or another
  /// one of the same elements.
  Mixture(const Soil& soil, const SoilBlock& b, int number, const FieldBlock& fields) {
    const SoilMaterial& material = *soil.materials[number];
    const Fluid* fluid = b.porous() ? material.fluid.get() : nullptr;
    alpha = material.biot_coefficient;
    grain_density = material.grain_density;
    fluid_density = fluid ? fluid->density() : 0.0;
    fluid_compliance = fluid && std::isfinite(fluid->bulk_modulus()) ? 1 / fluid->bulk_modulus() : 0.0;
    grain_compliance = material.grain_bulk_modulus > 0 ? 1 / material.grain_bulk_modulus : 0.0;
    grain_expansion = soil.grain_expansion.empty() ? 0.0 : soil.grain_expansion[number];
    fluid_expansion = soil.water_expansion;
    reference = soil.reference_temperature;
    if (material.permeability) conductivity = material.permeability->in_kernels();
    unit_weight = fluid ? fluid->unit_weight() : 0.0;
    retention = material.retention;
    viscosity_follows = soil.viscosity_follows;
    pressure = place_of_scalar(fields, soil.pressure);
    temperature = place_of_scalar(fields, soil.temperature);
  }

  /// Porosity after the volume ratio and, in saturated soil, the changes of pore pressure and temperature of the step.
  /// `warmer`: change of a temperature that is not among the scalar fields [K]. `swell`: volume strain ln J beyond that
  /// of the volume ratio [-].
  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION T porosity(double void_ratio, const PointFields<C, S, T>& at, double warmer = 0,
                                    double swell = 0) const {
    T grains = -warmer * grain_expansion;
    if constexpr (S > 0) {
      if (pressure >= 0) grains = at.change[pressure] * grain_compliance + grains;
      if (temperature >= 0) grains -= at.change[temperature] * grain_expansion;
    }
    return porosity_after<T>(alpha, void_ratio / (1 + void_ratio), logarithm(at.volume_ratio) + swell, grains);
  }
  /// Densities [kg/m3] at a temperature [degC]; the density of water here does not depend on pressure.
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
    if constexpr (S > 0)
      if (temperature >= 0)
        return (1.0 - n) * grain_density_at(at.value[temperature]) + n * fluid_density_at(at.value[temperature]);
    return (1.0 - n) * grain_density + n * saturation(at) * fluid_density;
  }
  /// Share of the pores that water fills.
  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION T saturation(const PointFields<C, S, T>& at) const {
    if constexpr (S > 0)
      if (pressure >= 0) return retention.saturation(at.value[pressure]);
    return T(1.0);
  }
  /// The part of a pore pressure that acts in the total stress [Pa].
  template <class T>
  KOKKOS_INLINE_FUNCTION T acting(const T& pore_pressure) const {
    return alpha * retention.acting(pore_pressure);
  }
  /// 1/viscosity of the water over that at the reference temperature (Vogel's formula) [-].
  template <class T>
  KOKKOS_INLINE_FUNCTION T fluidity(const T& temperature) const {
    constexpr double slope = 247.8 * 2.302585092994046, zero = 133.15;  // mu = 2.414e-5 Pa s 10^(247.8/(T + 133.15))
    if (!viscosity_follows) return T(1.0);
    return exponential(slope / (reference + zero) - slope / (temperature + zero));
  }
  /// 1/Q [1/Pa]
  template <class T>
  KOKKOS_INLINE_FUNCTION T storage(const T& n) const {
    return n * fluid_compliance + (alpha - n) * grain_compliance;
  }
};

/// Something that each material of a block has one of, found by point. T is trivially copyable.
template <class T>
struct ByMaterial {
  Kokkos::View<T*> of;  // by material number
  PointView which;      // (point, 0): material number

  ByMaterial() = default;
  /// make(k): that of material k.
  template <class Make>
  ByMaterial(const Soil& soil, const SoilBlock& b, const State& state, const Make& make)
      : of("by material", soil.materials.size()), which(soil.which(b, state)) {
    for (int k : b.made_of) of(k) = make(k);
  }
  KOKKOS_INLINE_FUNCTION const T& operator()(int row) const { return of(static_cast<int>(which(row, 0))); }
};

/// The mixtures of a block; `fields`: the block that is looped over, the soil's own or another one of the same
/// elements.
inline ByMaterial<Mixture> mixtures_of(const Soil& soil, const SoilBlock& b, const State& state,
                                       const FieldBlock& fields) {
  return {soil, b, state, [&](int k) { return Mixture(soil, b, k, fields); }};
}
inline ByMaterial<Mixture> mixtures_of(const Soil& soil, const SoilBlock& b, const State& state) {
  return mixtures_of(soil, b, state, b);
}

}  // namespace mudline
