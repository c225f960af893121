#pragma once

#include "materials/lode_shape.hpp"

namespace mudline {

/// Smooth cones in stress space, f in [Pa]:
///     f = sqrt(J2 K(S)^2 + apex^2) - slope p' - strength
/// hyperbolas in the meridian plane whose asymptote is the sharp cone; p' compression positive, apex = 0: sharp.

/// Gradient of a function of p', J2 and J3, by its coefficients:
///     volume/3 on the normal components + deviator dJ2/dsigma + cubic dJ3/dsigma
template <class T>
struct ConeGradient {
  T volume, deviator, cubic;

  KOKKOS_INLINE_FUNCTION void divide(double by) {
    volume *= 1.0 / by;
    deviator *= 1.0 / by;
    cubic *= 1.0 / by;
  }
};

/// Invariants of a stress for all cones: p', s, J2, J3 and the Lode measure.
template <class T>
struct ConeStress {
  T s[6], p, j2, j3, lode;
  bool has_lode;

  /// Where sqrt(J2) is below `negligible` [Pa] the deviator has no direction, and K is not needed.
  KOKKOS_INLINE_FUNCTION ConeStress(const T* stress, double negligible) {
    p = sym6::deviator(stress, s);
    j2 = 0.5 * sym6::norm_squared(s);
    j3 = sym6::determinant(s);
    has_lode = value(j2) > negligible * negligible;
    lode = has_lode ? 2.598076211353316 * j3 / (j2 * square_root(j2)) : T(0.0);
  }

  /// K and dK/dS of the shape.
  KOKKOS_INLINE_FUNCTION T shape(const LodeAngle& angle, const LodeShape& of, T& slope) const {
    if (!has_lode || of.circle) {
      slope = T(0.0);
      return T(1.0);
    }
    const LodeValue v = angle(of);
    slope = chain(lode, v.slope, v.curvature);
    return chain(lode, v.k, v.slope);
  }

  /// f and its gradient.
  template <class Strength>
  KOKKOS_INLINE_FUNCTION T evaluate(const LodeAngle& angle, const LodeShape& of, double slope, const Strength& strength,
                                    double apex, ConeGradient<T>& g) const {
    T k_slope;
    const T k = shape(angle, of, k_slope), root = square_root(j2 * k * k + apex * apex), half = 0.5 / root;
    g.volume = T(slope);
    // 2 J2 K dK = 2 K K' (3 sqrt(3)/2 dJ3/sqrt(J2) - 3/2 S dJ2)
    g.deviator = half * k * (k - 3.0 * lode * k_slope);
    g.cubic = has_lode && !of.circle ? half * 5.196152422706632 * k * k_slope / square_root(j2) : T(0.0);
    return root - slope * p - strength;
  }
  template <class Strength>
  KOKKOS_INLINE_FUNCTION T yield(const LodeAngle& angle, const LodeShape& of, double slope, const Strength& strength,
                                 double apex) const {
    T k_slope;
    const T k = shape(angle, of, k_slope);
    return square_root(j2 * k * k + apex * apex) - slope * p - strength;
  }

  /// The gradient as a strain-like six-vector.
  KOKKOS_INLINE_FUNCTION void expand(const ConeGradient<T>& g, T* out) const {
    T cubic[6];
    sym6::determinant_gradient(s, 3.0 * j2, cubic);
    for (int i = 0; i < 3; ++i) out[i] = g.volume * (1.0 / 3.0) + g.deviator * s[i] + g.cubic * cubic[i];
    for (int i = 3; i < 6; ++i) out[i] = 2.0 * g.deviator * s[i] + g.cubic * cubic[i];
  }

  /// e:e of the deviatoric part e of the gradient, as a tensor.
  KOKKOS_INLINE_FUNCTION T shear_squared(const ConeGradient<T>& g) const {
    return 2.0 * g.deviator * g.deviator * j2 + 6.0 * g.deviator * g.cubic * j3 +
           (2.0 / 3.0) * g.cubic * g.cubic * j2 * j2;
  }
};

/// Smooth maximum of two numbers, rounded where they differ by less than `width` and exact elsewhere; twice
/// continuously differentiable and convex. `difference` = first - second; returns the amount to be added to the second,
/// and its derivative in `weight`.
template <class T>
KOKKOS_INLINE_FUNCTION T smooth_excess(const T& difference, double width, T& weight) {
  const T x = difference / width;
  if (!(value(x) < 1.0)) {
    weight = T(1.0);
    return difference;
  }
  if (!(value(x) > -1.0)) {
    weight = T(0.0);
    return T(0.0);
  }
  weight = 0.5 + x * (0.75 - 0.25 * x * x);
  return width * (0.1875 + x * (0.5 + x * (0.375 - 0.0625 * x * x)));
}

}  // namespace mudline
