#pragma once

#include "materials/automatic_tangent.hpp"
#include "materials/earth_pressure.hpp"
#include "materials/frictional_model.hpp"

namespace mudline {

/// Undrained clay: Tresca with a strength that depends on depth, strain rate and remoulding; linear elastic.
///     yield       f = sqrt(J2) K(S) - s_u = 0, associated (isochoric); K = cos theta, corners rounded (lode_shape.hpp)
///     strength    s_u = s_u0 R(rate) [1/S_t + (1 - 1/S_t) exp(-3 xi/xi_95)]
///     rate        R = 1 + lambda log10(max(rate, ref)/ref)   or   (max(rate, ref)/ref)^beta
/// s_u0 grows with depth; each material point keeps the value of its initial position. xi is the accumulated plastic
/// shear strain; at xi_95, 95 % of the strength loss has occurred (Einav & Randolph 2005, IJNME 63:991; Zhou & Randolph
/// 2009, Int. J. Geomech. 9:211). Shear strains are sqrt(2 e:e), the engineering shear strain of simple shear and, at
/// constant volume, the difference of the principal strains in plane strain. The rate is that of the total strain,
/// constant over the increment, and part of the tangent; without time (dt = 0) R = 1. Below the reference rate R = 1 in
/// both laws, so that soil at rest keeps its strength. When the rate falls the stress returns to the smaller surface at
/// fixed strain. The law serves for effective stress in a u-p analysis as well as for total stress. Code: tension
/// positive, [Pa].
struct Tresca {
  static constexpr bool volume_apart = true, small_strain = true;
  enum class Rate { none, logarithmic, power };
  enum { strength_here, plastic_shear_strain, state_size };

  StrengthProfile strength;
  double shear_modulus = 0.0;  // [Pa] used if positive, else from `rigidity`
  double rigidity = 0.0;       // [-] G/s_u0
  double poisson = 0.49;       // [-]
  Rate rate = Rate::none;
  double rate_coefficient = 0.1;  // [-] lambda
  double rate_exponent = 0.05;    // [-] beta
  double reference_rate = 1e-5;   // [1/s]
  double sensitivity = 1.0;       // [-] S_t
  double ductility = 10.0;        // [-] xi_95
  double transition = 29.0;       // [deg]
  IntegrationOptions integration = IntegrationOptions::implicit();

  void parameters(Parameters& p);
  void check(const Section& section) const;
  /// The strength is divided by `factor`, with its rate and softening; a stiffness from the rigidity index stays.
  void reduce_strength(double factor) { reduction_ = factor; }
  void prepare() { shape_ = LodeShape::mohr_coulomb(0.0, transition); }
  static std::vector<StateVariable> state();
  std::string initialise(const InitialPoint& point, double* state) const;
  /// The strength at the reference rate that remoulding has left.
  SoilState soil_state(const double*, double, const double* state) const;
  EarthPressures earth_pressures(double vertical, double height) const {
    return rankine_earth_pressures(vertical, 0.0, strength.at(height));
  }

  KOKKOS_INLINE_FUNCTION ElasticModuli moduli(const double*, double, const double* state) const {
    const double shear = shear_modulus > 0.0 ? shear_modulus : rigidity * state[strength_here];
    return {shear * 2.0 * (1.0 + poisson) / (3.0 * (1.0 - 2.0 * poisson)), shear};
  }
  /// Rate factor R of the strain increment.
  template <class T>
  KOKKOS_INLINE_FUNCTION T rate_factor(const T* strain, double dt) const;
  template <class T>
  KOKKOS_INLINE_FUNCTION bool update(const SkeletonPoint& in, const T* strain, const double* state_old, T* stress,
                                     double* state) const;

 private:
  double reduction_ = 1;  // [-] factor by which the strength of a point is divided
  LodeShape shape_;
};

/// The model of the law for one increment. S is the number type of the strength, which depends on the strain through
/// the rate. h = (xi).
template <class S>
struct TrescaModel : ConstantElasticity {
  static constexpr int hardening = 1;
  static constexpr bool associated = true;

  const LodeShape& shape;
  S strength;        // [Pa] intact, at the rate of the increment
  double remoulded;  // [-] 1/S_t
  double ductility;  // [-]
  double scale;      // [Pa]

  /// Fraction of the strength that remains, and its derivative.
  template <class T>
  KOKKOS_INLINE_FUNCTION T remaining(const T& xi, T& slope) const {
    const T lost = (1.0 - remoulded) * exponential(-3.0 / ductility * xi);
    slope = -3.0 / ductility * lost;
    return remoulded + lost;
  }
  /// Rounds the surface at the axis, where the deviator has no direction; the effect on the strength is negligible.
  KOKKOS_INLINE_FUNCTION double apex() const { return 1e-7 * scale; }

  template <class T>
  KOKKOS_INLINE_FUNCTION T yield(const T* stress, const T* h) const {
    const ConeStress<T> at(stress, apex());
    T slope;
    const T s = number_as<T>(strength) * remaining(h[0], slope);
    return at.yield(LodeAngle(value(at.lode), shape.edge), shape, 0.0, s, apex()) / scale;
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION void flow(const T* stress, const T* h, const T&, PlasticFlow<T, 1>& out) const {
    const ConeStress<T> at(stress, apex());
    ConeGradient<T> g;
    at.evaluate(LodeAngle(value(at.lode), shape.edge), shape, 0.0, 0.0, apex(), g);
    g.divide(scale);
    at.expand(g, out.yield_gradient);
    out.bulk = T(bulk);
    out.shear = T(ConstantElasticity::shear);
    T slope;
    remaining(h[0], slope);
    out.hardening_gradient[0] = number_as<T>(strength) * slope / -scale;
    const T squared = 2.0 * at.shear_squared(g);
    out.hardening_rate[0] = value(squared) * scale * scale > 1e-20 ? square_root(squared) : T(0.0);
  }
};

template <class T>
KOKKOS_INLINE_FUNCTION T Tresca::rate_factor(const T* strain, double dt) const {
  if (rate == Rate::none || !(dt > 0.0)) return T(1.0);
  const T mean = sym6::trace(strain) * (1.0 / 3.0);
  T squared(0.0);
  for (int i = 0; i < 3; ++i) squared += 2.0 * (strain[i] - mean) * (strain[i] - mean);
  for (int i = 3; i < 6; ++i) squared += strain[i] * strain[i];
  const double least = reference_rate * dt;
  if (!(value(squared) > least * least)) return T(1.0);
  const T ratio = square_root(squared) / least;
  if (rate == Rate::power) {
    const double f = ::pow(value(ratio), rate_exponent);
    return chain(ratio, f, rate_exponent * f / value(ratio));
  }
  const double per_decade = rate_coefficient / ::log(10.0);
  return chain(ratio, 1.0 + per_decade * ::log(value(ratio)), per_decade / value(ratio));
}

template <class T>
KOKKOS_INLINE_FUNCTION bool Tresca::update(const SkeletonPoint& in, const T* strain, const double* state_old, T* stress,
                                           double* state) const {
  const double intact = state_old[strength_here] / reduction_;
  const ElasticModuli m = moduli(in.stress, in.void_ratio, state_old);
  const TrescaModel<T> model{{m.bulk, m.shear}, shape_,    intact * rate_factor(strain, in.dt),
                             1.0 / sensitivity, ductility, intact};
  return integrate_point(model, integration, in, strain, state_old[plastic_shear_strain], stress,
                         state[plastic_shear_strain]);
}

// Compiled once, in the source of the law.
extern template class PointwiseSkeleton<AutomaticTangent<Tresca>>;

}  // namespace mudline
