#pragma once

#include "materials/automatic_tangent.hpp"
#include "materials/earth_pressure.hpp"
#include "materials/frictional_model.hpp"

namespace mudline {

/// Drucker-Prager, linear elastic and perfectly plastic (Drucker & Prager 1952; matching: Chen & Mizuno 1990, Nonlinear
/// Analysis in Soil Mechanics). p' compression positive:
///     yield      f = sqrt(J2 + (a k)^2) - eta p' - k = 0
///     potential  g = sqrt(J2 + (a k)^2) - eta_psi p'
/// eta and k are given, or those of a cone that meets Mohr-Coulomb (phi, c):
///     compression    eta = 6 sin(phi)/(sqrt(3) (3 - sin(phi))), the outer edges of the hexagon; k = eta c cot(phi)
///     extension      eta = 6 sin(phi)/(sqrt(3) (3 + sin(phi))), the inner edges
///     plane strain   the same collapse load in plane strain, for any dilation:
///                    eta = sin(phi)/(sqrt(1 - eta_psi^2/3) + eta_psi sin(phi)/3),
///                    eta_psi = sqrt(3) sin(psi)/sqrt(3 + sin^2(psi))
/// a is the fraction of the distance from the origin to the tip that the hyperbola cuts off. Tension cut-off as in
/// Mohr-Coulomb (frictional_model.hpp), at most sqrt(3) k/(1 + eta/sqrt(3)), the uniaxial tensile strength of the cone.
/// Code: tension positive, [Pa].
struct DruckerPrager : ConeTip {
  static constexpr bool small_strain = true;
  enum class Match { compression, extension, plane_strain, direct };
  enum { plastic_shear_strain, state_size };

  ElasticConstants elasticity;
  Match match = Match::plane_strain;
  double friction = 0.0, dilation = 0.0;     // [deg] phi, psi
  double cohesion = 0.0;                     // [Pa] c
  double slope = 0.0, dilation_slope = 0.0;  // [-] eta, eta_psi
  double intercept = 0.0;                    // [Pa] k
  IntegrationOptions integration = IntegrationOptions::implicit();

  void parameters(Parameters& p);
  void check(const Section& section) const;
  /// c, tan(phi) (or eta and k of a direct cone) and the tensile strength are divided by `factor`; psi is at most phi.
  void reduce_strength(double factor);
  /// Computes slopes and intercept of a matched cone.
  void prepare();
  static std::vector<StateVariable> state();
  std::string initialise(const InitialPoint& point, double* state) const;
  /// (1 - sin(phi)) R^sin(phi) as for Mohr-Coulomb; negative (none) for a cone given directly.
  double k0(double overconsolidation_ratio) const;
  EarthPressures earth_pressures(double vertical, double) const {
    return cone_earth_pressures(vertical, slope, intercept);
  }

  KOKKOS_INLINE_FUNCTION ElasticModuli moduli(const double*, double, const double*) const {
    return elasticity.moduli();
  }
  KOKKOS_INLINE_FUNCTION FrictionalModel model(const double* stress) const {
    const ElasticModuli m = elasticity.moduli();
    const double p = ::fmax(sym6::mean_pressure(stress), 0.0), uniaxial = 3.0 * intercept / (::sqrt(3.0) + slope);
    return {{m.bulk, m.shear},
            circle_,
            circle_,
            tension_shape_,
            slope,
            dilation_slope,
            intercept,
            ::fmin(tensile, uniaxial),
            apex * intercept,
            apex * intercept,
            intercept + slope * p};
  }
  template <class T>
  KOKKOS_INLINE_FUNCTION bool update(const SkeletonPoint& in, const T* strain, const double* state_old, T* stress,
                                     double* state) const {
    return integrate_point(model(in.stress), integration, in, strain, state_old[plastic_shear_strain], stress,
                           state[plastic_shear_strain]);
  }

 private:
  LodeShape circle_, tension_shape_;
};

// Compiled once, in the source of the law.
extern template class PointwiseSkeleton<AutomaticTangent<DruckerPrager>>;

}  // namespace mudline
