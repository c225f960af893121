#pragma once

#include <cmath>

#include "core/pi.hpp"
#include "materials/automatic_tangent.hpp"
#include "materials/cone.hpp"

namespace mudline {

/// Linear isotropic elasticity of a plastic law.
struct ElasticConstants {
  double young = 2e7;    // [Pa]
  double poisson = 0.3;  // [-]

  void parameters(Parameters& p) {
    p.required("Young's modulus", young, "Pa", positive(), "Stiffness of the soil skeleton before yield");
    p.required("Poisson's ratio", poisson, "-", half_open(0.0, 0.5), "Ratio of lateral contraction to extension");
  }
  KOKKOS_INLINE_FUNCTION ElasticModuli moduli() const {
    return {young / (3.0 * (1.0 - 2.0 * poisson)), 0.5 * young / (1.0 + poisson)};
  }
};

/// The angle [deg] whose tangent is that of `angle` [deg] divided by `factor`.
inline double angle_over(double factor, double angle) {
  return std::atan(std::tan(angle * pi / 180.0) / factor) * 180.0 / pi;
}

/// A strength that grows linearly with the initial depth of a point; the point keeps it while it moves.
struct StrengthProfile {
  double value = 0.0;      // [Pa] at the reference elevation and above
  double gradient = 0.0;   // [Pa/m] growth with depth below it
  double elevation = 0.0;  // [m]

  void parameters(Parameters& p, const std::string& name) {
    p.required(name, value, "Pa", non_negative(), "At the reference elevation, and above it");
    p.add(name + " gradient", gradient, "Pa/m", non_negative(),
          "Increase per metre of depth below the reference elevation");
    p.add("reference elevation", elevation, "m", any(), "Height from which the depth of the gradient counts");
    if (p.given("reference elevation") && !p.given(name + " gradient"))
      p.deck().fail("has a meaning only together with '" + name + " gradient'", "reference elevation");
    if (p.varies(name) && gradient != 0.0)
      p.deck().fail("has no meaning where the value itself is a function of the place", name + " gradient");
  }
  double at(double height) const { return value + gradient * ::fmax(0.0, elevation - height); }
};

/// Parameters for closing the tip of a cone; base of the laws that have one.
struct ConeTip {
  double tensile = 1e12;  // [Pa] largest principal stress
  double apex = 0.05;     // [-] fraction of the distance from the origin to the tip that the hyperbola cuts off

  void parameters(Parameters& p) {
    p.add(
        "tensile strength", tensile, "Pa", non_negative(),
        "Limit of the largest principal stress; the uniaxial tensile strength of the cone itself holds where lower, as "
        "by default");
    p.add("apex rounding", apex, "-", half_open(1e-4, 0.5),
          "Part of the distance from the origin to the tip of the cone that the rounding cuts off");
  }
};

/// Model of perfectly plastic frictional soil for stress integration: a shear cone with its own potential, and a
/// tension cut-off.
///     f_s = sqrt(J2 K^2 + m^2) - eta p' - k               shear, K of the law's shape, potential with eta and K of
///     dilation f_t = sqrt(J2 K_R^2 + m^2) - p' - t                 rounded Rankine: largest principal stress at most
///     t; associated
/// joined by a twice continuously differentiable maximum where they differ by less than m; the flow directions have the
/// same weights as the gradients. So stress, normal and flow are smooth everywhere, and the stress can return from any
/// tension even with zero dilation. h = (plastic shear strain), sqrt(2/3 e:e) of the plastic deviatoric strain; it is
/// for output only.
struct FrictionalModel : ConstantElasticity {
  static constexpr int hardening = 1;
  static constexpr bool associated = false;

  const LodeShape& yield_shape;
  const LodeShape& potential_shape;
  const LodeShape& tension_shape;
  double slope, dilation;       // [-] eta of yield and potential
  double strength, tensile;     // [Pa] k and t
  double apex, potential_apex;  // [Pa] m of yield (and tension) and potential
  double scale;                 // [Pa] makes f dimensionless

  template <class T>
  KOKKOS_INLINE_FUNCTION T yield(const T* stress, const T*) const {
    const ConeStress<T> at(stress, 1e-9 * apex);
    const LodeAngle angle(value(at.lode), tension_shape.edge);
    const double apart = difference(at, angle);
    if (apart >= apex) return at.yield(angle, yield_shape, slope, strength, apex) / scale;
    const T tension = at.yield(angle, tension_shape, 1.0, tensile, apex);
    if (apart <= -apex) return tension / scale;
    T weight;
    const T excess = at.yield(angle, yield_shape, slope, strength, apex) - tension;
    return (tension + smooth_excess(excess, apex, weight)) / scale;
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION void flow(const T* stress, const T*, const T&, PlasticFlow<T, 1>& out) const {
    const ConeStress<T> at(stress, 1e-9 * apex);
    const LodeAngle angle(value(at.lode), tension_shape.edge);
    const double apart = difference(at, angle);
    ConeGradient<T> a, b;  // gradients of yield function and potential
    if (apart >= apex) {
      at.evaluate(angle, yield_shape, slope, strength, apex, a);
      at.evaluate(angle, potential_shape, dilation, 0.0, potential_apex, b);
    } else if (apart <= -apex) {
      at.evaluate(angle, tension_shape, 1.0, tensile, apex, a);
      b = a;
    } else {
      ConeGradient<T> tension;
      const T shear = at.evaluate(angle, yield_shape, slope, strength, apex, a);
      const T excess = shear - at.evaluate(angle, tension_shape, 1.0, tensile, apex, tension);
      at.evaluate(angle, potential_shape, dilation, 0.0, potential_apex, b);
      T weight;
      smooth_excess(excess, apex, weight);
      a = mix(a, tension, weight);
      b = mix(b, tension, weight);
    }
    a.divide(scale);
    b.divide(scale);
    at.expand(a, out.yield_gradient);
    at.expand(b, out.flow_direction);
    out.bulk = T(bulk);
    out.shear = T(ConstantElasticity::shear);
    out.hardening_gradient[0] = T(0.0);
    const T squared = (2.0 / 3.0) * at.shear_squared(b);
    out.hardening_rate[0] = value(squared) * scale * scale > 1e-20 ? square_root(squared) : T(0.0);
  }

 private:
  /// Value of f_s - f_t, which tells which of the two is needed.
  template <class T>
  KOKKOS_INLINE_FUNCTION double difference(const ConeStress<T>& at, const LodeAngle& angle) const {
    const double j2 = value(at.j2), p = value(at.p);
    const double shear = at.has_lode ? angle(yield_shape).k : 1.0, tension = at.has_lode ? angle(tension_shape).k : 1.0;
    return ::sqrt(j2 * shear * shear + apex * apex) - slope * p - strength -
           (::sqrt(j2 * tension * tension + apex * apex) - p - tensile);
  }
  /// weight * first + (1 - weight) * second.
  template <class T>
  KOKKOS_INLINE_FUNCTION ConeGradient<T> mix(const ConeGradient<T>& first, const ConeGradient<T>& second,
                                             const T& weight) const {
    const T other = 1.0 - weight;
    return {weight * first.volume + other * second.volume, weight * first.deviator + other * second.deviator,
            weight * first.cubic + other * second.cubic};
  }
};

}  // namespace mudline
