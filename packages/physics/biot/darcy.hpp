#pragma once

#include "framework/element_loop.hpp"
#include "physics/mixture.hpp"
#include "tensor/midpoint_rule.hpp"

namespace mudline {

/// Darcy's law at the points of one block of saturated soil, for laws of balance that have the pore pressure among
/// their scalar fields and whose points are the soil's: w = -k(e)/gamma_w (grad p - rho_f g). With a temperature,
/// viscosity and weight of the water depend on it, whether or not it is among the scalar fields.
struct Darcy {
  ByMaterial<Mixture> mixture;
  double gravity[3];     // [m/s2]
  double lift;           // fluid density whose weight excess pore pressures leave out [kg/m3]
  PointView void_ratio;  // (point; e and initial e) at the start of the step
  PointView ratios;      // (point; tensor of PermeabilityRatios) at the start of the step; empty: all of ones
  PointView numbers;     // (point; numbers of the conductivity); empty: those of the material
  PointView elsewhere;   // (point; temperature, its change since the start of the step) if it is not among the fields

  /// For laws with the soil's own fields.
  Darcy(const Soil& soil, const SoilBlock& block, const StepView& view) : Darcy(soil, block, view, block, {}) {}
  /// For laws with other fields of the same elements, at the level of their loop.
  Darcy(const Soil& soil, const SoilBlock& block, const StepView& view, const FieldBlock& fields,
        const LoopLevel& level);

  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION T porosity(int row, const PointFields<C, S, T>& at) const {
    return mixture(row).porosity(void_ratio(row, 0), at, elsewhere.extent(0) > 0 ? elsewhere(row, 1) : 0.0);
  }
  /// Whether the model has a temperature.
  KOKKOS_INLINE_FUNCTION bool warm(const Mixture& here) const {
    return here.temperature >= 0 || elsewhere.extent(0) > 0;
  }
  /// Temperature of a warm model [degC].
  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION T temperature(int row, const PointFields<C, S, T>& at) const {
    const Mixture& here = mixture(row);
    return here.temperature >= 0 ? at.value[here.temperature] : T(elsewhere(row, 0));
  }
  /// Mobility k/gamma_w [m2/(Pa s)] at a porosity and at the viscosity for which the conductivity is given.
  template <class T>
  KOKKOS_INLINE_FUNCTION T mobility(int row, const T& n) const {
    const T e = n / (1.0 - n);
    const Mixture& here = mixture(row);
    const Conductivity law =
        numbers.extent(0) > 0 ? here.conductivity.with_numbers(&numbers(row, 0)) : here.conductivity;
    const Conductivity::Value k = law(value(e), void_ratio(row, 1));
    return chain(e, k.k, k.dk_de) * (1 / here.unit_weight);
  }
  /// Minus the discharge [m/s] by a mobility [m2/(Pa s)] and what drives the flow, grad p - rho_f g [N/m3].
  template <int D, class T>
  KOKKOS_INLINE_FUNCTION void minus_discharge(int row, const T& mobility, const T (&drive)[D], T (&w)[D]) const {
    for (int i = 0; i < D; ++i) {
      T along = drive[i];
      if (ratios.extent(0) > 0) {
        along = 0.0;
        for (int j = 0; j < D; ++j) along += ratios(row, six(i, j)) * drive[j];
      }
      w[i] = mobility * along;
    }
  }
  /// Minus the discharge, kappa (grad p - rho_f g) [m/s]. It has no acceleration of the fluid.
  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION void minus_discharge(int row, const PointFields<C, S, T>& at, T (&w)[C::dim]) const {
    const Mixture& here = mixture(row);
    T kappa = mobility(row, porosity(row, at)), weight = here.fluid_density - lift;
    if (here.retention.acts()) kappa = kappa * here.retention.relative_permeability(at.value[here.pressure]);
    if (warm(here)) {
      const T t = temperature(row, at);
      kappa = kappa * here.fluidity(t);
      weight = here.fluid_density_at(t) - lift;
    }
    T drive[C::dim];
    for (int i = 0; i < C::dim; ++i) drive[i] = at.gradient[here.pressure][i] - weight * gravity[i];
    minus_discharge(row, kappa, drive, w);
  }
};

}  // namespace mudline
