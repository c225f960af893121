#pragma once

#include "materials/automatic_tangent.hpp"
#include "materials/earth_pressure.hpp"
#include "materials/frictional_model.hpp"

namespace mudline {

/// Mohr-Coulomb, linear elastic (or stiffer with the pressure) and perfectly plastic, smooth everywhere (Abbo & Sloan
/// 1995, Computers & Structures 54:427; Abbo, Lyamin, Sloan & Hambleton 2011, IJSS 48:3001). p' compression positive:
///     yield      f = sqrt(J2 K(S)^2 + m^2) - p' sin(phi) - c cos(phi) = 0, m = a c cos(phi)
///     potential  g = sqrt(J2 K_psi(S)^2 + (a c cos(psi))^2) - p' sin(psi)
/// K rounds the corners of the hexagon (lode_shape.hpp), the hyperbola rounds the tip: a is the fraction of the
/// distance from the origin to the sharp tip, c cot(phi), that it cuts off. The largest principal stress is limited to
/// the tensile strength by a rounded Rankine surface (frictional_model.hpp), at most 2 c cos(phi)/(1 + sin(phi)), the
/// uniaxial tensile strength of the cone itself: above that only states with three tensile principal stresses would
/// differ, and with psi = 0 none of them could be returned to the cone. c grows with depth; each material point keeps
/// the value of its initial position. Code: tension positive, [Pa].
///
/// Stiffness (Ohde 1939; Schanz, Vermeer & Bonnier 1999, Beyond 2000 in Computational Geotechnics, p. 281): with an
/// exponent n
///     E = E_ref ((c cos(phi) + p' sin(phi)) / (c cos(phi) + p_ref sin(phi)))^n,  p' >= 0 of the start of the increment
/// An initial stress outside the surface is returned to it at fixed strain when the law is first evaluated.
struct MohrCoulomb : ConeTip {
  static constexpr bool small_strain = true;
  enum { cohesion_here, plastic_shear_strain, state_size };

  ElasticConstants elasticity;
  double exponent = 0.0;            // [-] n
  double reference_pressure = 1e5;  // [Pa] p_ref
  StrengthProfile cohesion;
  double friction = 30.0, dilation = 0.0;  // [deg] phi, psi
  double transition = 29.0;                // [deg] theta_T
  IntegrationOptions integration = IntegrationOptions::implicit();

  void parameters(Parameters& p);
  void check(const Section& section) const;
  /// c, tan(phi) and the tensile strength are divided by `factor`; psi is at most phi.
  void reduce_strength(double factor);
  /// Computes constants from the parameters.
  void prepare();
  static std::vector<StateVariable> state();
  std::string initialise(const InitialPoint& point, double* state) const;
  /// (1 - sin(phi)) R^sin(phi), at most the passive ratio (Jaky 1944; Mayne & Kulhawy 1982).
  double k0(double overconsolidation_ratio) const;
  /// Without friction the cohesion is the undrained strength.
  SoilState soil_state(const double*, double, const double* state) const {
    return friction > 0.0 ? SoilState{} : SoilState{state[cohesion_here], {}};
  }
  EarthPressures earth_pressures(double vertical, double height) const {
    return rankine_earth_pressures(vertical, sine_, cohesion.at(height));
  }

  KOKKOS_INLINE_FUNCTION ElasticModuli moduli(const double* stress, double, const double* state) const {
    return moduli_at(::fmax(sym6::mean_pressure(stress), 0.0), state[cohesion_here]);
  }
  KOKKOS_INLINE_FUNCTION FrictionalModel model(double c, const double* stress) const;
  template <class T>
  KOKKOS_INLINE_FUNCTION bool update(const SkeletonPoint& in, const T* strain, const double* state_old, T* stress,
                                     double* state) const;

 private:
  KOKKOS_INLINE_FUNCTION ElasticModuli moduli_at(double p, double c) const {
    ElasticModuli m = elasticity.moduli();
    if (exponent == 0.0) return m;
    const double share = ::pow((c * cosine_ + p * sine_) / (c * cosine_ + reference_pressure * sine_), exponent);
    m.bulk *= share;
    m.shear *= share;
    return m;
  }

  double reduction_ = 1;  // [-] factor by which the cohesion of a point is divided
  double sine_ = 0, cosine_ = 1, dilation_sine_ = 0, dilation_cosine_ = 1;
  LodeShape yield_shape_, potential_shape_, tension_shape_;
};

KOKKOS_INLINE_FUNCTION FrictionalModel MohrCoulomb::model(double c, const double* stress) const {
  const double strength = c * cosine_, p = ::fmax(sym6::mean_pressure(stress), 0.0);
  const ElasticModuli m = moduli_at(p, c);
  return {{m.bulk, m.shear},
          yield_shape_,
          potential_shape_,
          tension_shape_,
          sine_,
          dilation_sine_,
          strength,
          ::fmin(tensile, 2.0 * strength / (1.0 + sine_)),
          apex * strength,
          apex * c * dilation_cosine_,
          strength + p * sine_};
}

template <class T>
KOKKOS_INLINE_FUNCTION bool MohrCoulomb::update(const SkeletonPoint& in, const T* strain, const double* state_old,
                                                T* stress, double* state) const {
  return integrate_point(model(state_old[cohesion_here] / reduction_, in.stress), integration, in, strain,
                         state_old[plastic_shear_strain], stress, state[plastic_shear_strain]);
}

// Compiled once, in the source of the law.
extern template class PointwiseSkeleton<AutomaticTangent<MohrCoulomb>>;

}  // namespace mudline
