#pragma once

#include "materials/automatic_tangent.hpp"
#include "materials/earth_pressure.hpp"
#include "materials/frictional_model.hpp"

namespace mudline {

/// Von Mises with isotropic hardening, linear elastic, associated (Simo & Hughes 1998, Computational Inelasticity, ch.
/// 3).
///     yield       f = q - sigma_y(k) = 0, q = sqrt(3 J2)
///     hardening   sigma_y = sigma_0 + H k + Q (1 - exp(-b k)): linear and Voce's, either may be absent
/// k is the equivalent plastic strain, dk = sqrt(2/3 de_p:de_p). With sigma_y = 2 s_u (triaxial) or sqrt(3) s_u (plane
/// strain) it is undrained clay without corners. Code: tension positive, [Pa].
struct VonMises {
  static constexpr bool volume_apart = true, small_strain = true;
  enum { equivalent_plastic_strain, state_size };

  ElasticConstants elasticity;
  double yield_stress = 1e5;   // [Pa] sigma_0
  double hardening = 0.0;      // [Pa] H
  double saturation = 0.0;     // [Pa] Q
  double saturation_rate = 0;  // [-] b
  IntegrationOptions integration = IntegrationOptions::implicit();

  void parameters(Parameters& p);
  void check(const Section& section) const;
  /// The yield stress is divided by `factor`, with its hardening.
  void reduce_strength(double factor) {
    for (double* part : {&yield_stress, &hardening, &saturation}) *part /= factor;
  }
  static std::vector<StateVariable> state();
  std::string initialise(const InitialPoint&, double* state) const {
    state[equivalent_plastic_strain] = 0.0;
    return "";
  }
  /// Undrained strength in simple shear.
  SoilState soil_state(const double*, double, const double*) const { return {yield_stress / std::sqrt(3.0), {}}; }
  EarthPressures earth_pressures(double vertical, double) const {
    return cone_earth_pressures(vertical, 0.0, yield_stress / std::sqrt(3.0));
  }

  KOKKOS_INLINE_FUNCTION ElasticModuli moduli(const double*, double, const double*) const {
    return elasticity.moduli();
  }
  template <class T>
  KOKKOS_INLINE_FUNCTION bool update(const SkeletonPoint& in, const T* strain, const double* state_old, T* stress,
                                     double* state) const;
};

/// The model of the law for one increment; h = (k).
struct VonMisesModel : ConstantElasticity {
  static constexpr int hardening = 1;
  static constexpr bool associated = true;

  const VonMises& law;

  /// q, rounded at the axis with a negligible effect on the strength.
  template <class T>
  KOKKOS_INLINE_FUNCTION T deviator(const T* stress, T* s) const {
    const double round = 1e-7 * law.yield_stress;
    sym6::deviator(stress, s);
    return square_root(1.5 * sym6::norm_squared(s) + round * round);
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION T yield(const T* stress, const T* h) const {
    T s[6];
    const T q = deviator(stress, s);
    const T voce = law.saturation * (1.0 - exponential(-law.saturation_rate * h[0]));
    return (q - law.yield_stress - law.hardening * h[0] - voce) / law.yield_stress;
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION void flow(const T* stress, const T* h, const T&, PlasticFlow<T, 1>& out) const {
    T s[6];
    const T factor = 1.5 / (law.yield_stress * deviator(stress, s));
    for (int i = 0; i < 6; ++i) out.yield_gradient[i] = (i < 3 ? 1.0 : 2.0) * factor * s[i];
    out.bulk = T(bulk);
    out.shear = T(ConstantElasticity::shear);
    const double rate = law.saturation_rate;
    out.hardening_gradient[0] = (law.hardening + law.saturation * rate * exponential(-rate * h[0])) / -law.yield_stress;
    out.hardening_rate[0] = T(1.0 / law.yield_stress);
  }
};

template <class T>
KOKKOS_INLINE_FUNCTION bool VonMises::update(const SkeletonPoint& in, const T* strain, const double* state_old,
                                             T* stress, double* state) const {
  const ElasticModuli m = elasticity.moduli();
  const VonMisesModel model{{m.bulk, m.shear}, *this};
  return integrate_point(model, integration, in, strain, state_old[equivalent_plastic_strain], stress,
                         state[equivalent_plastic_strain]);
}

// Compiled once, in the source of the law.
extern template class PointwiseSkeleton<AutomaticTangent<VonMises>>;

}  // namespace mudline
