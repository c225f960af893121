#pragma once

#include "materials/pointwise.hpp"
#include "tensor/sym6.hpp"

namespace mudline {

/// Isotropic linear elasticity in rate form: sigma' = sigma'_old + K tr(deps) 1 + 2 G dev(deps), tension positive, so
/// that a given initial stress is kept. K = E/(3(1-2nu)), G = E/(2(1+nu)). No state.
struct LinearElastic {
  static constexpr bool volume_apart = true, no_strength = true, small_strain = true;
  double young = 1.0e7;  // [Pa] drained
  double poisson = 0.3;  // [-] drained

  void parameters(Parameters& p) {
    p.required("Young's modulus", young, "Pa", positive(), "Drained stiffness of the soil skeleton");
    p.required("Poisson's ratio", poisson, "-", open(-1.0, 0.5), "Drained ratio of lateral contraction to extension");
  }
  static std::vector<StateVariable> state() { return {}; }
  std::string initialise(const InitialPoint&, double*) const { return ""; }

  KOKKOS_INLINE_FUNCTION ElasticModuli moduli(const double*, double, const double*) const {
    return {young / (3.0 * (1.0 - 2.0 * poisson)), 0.5 * young / (1.0 + poisson)};
  }

  KOKKOS_INLINE_FUNCTION bool operator()(const SkeletonPoint& in, const double*, double*, SkeletonResponse& out) const {
    const ElasticModuli m = moduli(in.stress, in.void_ratio, nullptr);
    sym6::isotropic(m.bulk, m.shear, in.strain, out.stress);
    for (int i = 0; i < 6; ++i) out.stress[i] += in.stress[i];
    if (in.want_tangent) sym6::isotropic_stiffness(m.bulk, m.shear, out.tangent);
    return true;
  }

  /// Stress ratio of one-dimensional (oedometric) compression from zero stress.
  double k0(double) const { return poisson / (1.0 - poisson); }
};

}  // namespace mudline
