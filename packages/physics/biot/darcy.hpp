#pragma once

#include "framework/term.hpp"
#include "physics/mixture.hpp"

namespace mudline {

/// Darcy's law at the points of one block of saturated soil, for laws of balance whose first scalar is the pore
/// pressure and whose points are the soil's: w = -k(e)/gamma_w (grad p - rho_f g).
struct Darcy {
  Mixtures mixture;
  double gravity[3];     // [m/s2] of water whose weight the pressures hold
  PointView void_ratio;  // (point; e and initial e) at the start of the step

  Darcy(const Soil& soil, const SoilBlock& block, const StepView& view)
      : mixture(soil, block, *view.committed), void_ratio(view.committed->arrays[block.void_ratio]) {
    const auto g = soil.water_gravity(view.balance.time);
    for (int i = 0; i < 3; ++i) gravity[i] = g[i];
  }
  template <class C, int S, class T>
  T porosity(int row, const PointFields<C, S, T>& at) const {
    return mixture(row).porosity(void_ratio(row, 0), at);
  }
  /// k/gamma_w [m2/(Pa s)] at a porosity.
  template <class T>
  T mobility(int row, const T& n) const {
    const T e = n / (1.0 - n);
    const Mixture& here = mixture(row);
    const Permeability::Value k = here.permeability->conductivity(value(e), void_ratio(row, 1));
    return chain(e, k.k, k.dk_de) * (1 / here.unit_weight);
  }
  /// Minus the discharge, kappa (grad p - rho_f g) [m/s]; what drives it may have more.
  template <class C, int S, class T>
  void minus_discharge(int row, const PointFields<C, S, T>& at, T (&w)[C::dim]) const {
    const T kappa = mobility(row, porosity(row, at));
    for (int i = 0; i < C::dim; ++i) w[i] = kappa * (at.gradient[0][i] - mixture(row).fluid_density * gravity[i]);
  }
};

}  // namespace mudline
