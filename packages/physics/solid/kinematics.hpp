#pragma once

#include <cmath>

#include "physics/element.hpp"

namespace mudline {

/// Objective increment between the committed configuration x_n and x_{n+1} (Hughes and Winget 1980): gradient on the
/// midpoint configuration, H = d(Delta u)/d x_{n+1/2}; strain = sym H, rotation by the angle 2 atan(w/2) with the spin
/// w = (H_yx - H_xy)/2. A pure rotation gives no strain. The trace of the strain increment is replaced by ln J, so that
/// the skeleton's volume strain is the one that the void ratio and the pore water see, whatever the size of the step.
/// sym H has the axes of the midpoint: it is turned on by half the angle to those of the end, where stress and state are.
/// Without that the stress would be of first order only in the step where strain and rotation come together.
/// Everything is built from the increments of displacement, not from differences of positions: strains of 1e-12 would drown
/// in the rounding of coordinates.
template <int N>
struct IncrementKinematics {
  double g[N][2];      // dN/dx at the midpoint [1/m]
  double g_end[N][2];  // dN/dx at n+1 [1/m]
  double shape_over_r[N], shape_over_r_end[N];  // N_a / r at the midpoint and at n+1 (axisymmetric), else 0
  double H[2][2], hoop;
  double spin;         // w [-]
  double cosine, sine; // of the rotation
  double half_cosine, half_sine;  // of half of it
  double increment[4]; // strain xx yy zz(hoop) xy (engineering shear), axes of the end
  double log_volume;   // ln J, J = dv_{n+1} / dv_n
  bool ok;

  /// du: the nodes' displacement of the step, x_end - x_old without its rounding.
  KOKKOS_INLINE_FUNCTION void compute(const double (&x_old)[N][2], const double (&x_end)[N][2], const double (&du)[N][2],
                                      const double* dN, const double* shape, bool axisymmetric) {
    double middle[N][2];
    for (int a = 0; a < N; ++a)
      for (int i = 0; i < 2; ++i) middle[a][i] = 0.5 * (x_old[a][i] + x_end[a][i]);
    PointGeometry<N> at_old, at_end, at_middle;
    at_old.compute(x_old, dN, shape, axisymmetric);
    at_end.compute(x_end, dN, shape, axisymmetric);
    at_middle.compute(middle, dN, shape, axisymmetric);
    ok = at_end.ok && at_middle.ok && at_old.ok;
    H[0][0] = H[0][1] = H[1][0] = H[1][1] = hoop = 0;
    for (int a = 0; a < N; ++a) {
      g[a][0] = at_middle.g[a][0];
      g[a][1] = at_middle.g[a][1];
      g_end[a][0] = at_end.g[a][0];
      g_end[a][1] = at_end.g[a][1];
      shape_over_r[a] = axisymmetric && ok ? shape[a] / at_middle.r : 0.0;
      shape_over_r_end[a] = axisymmetric && ok ? shape[a] / at_end.r : 0.0;
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) H[i][j] += du[a][i] * g[a][j];
      hoop += du[a][0] * shape_over_r[a];
    }
    // exactly: dx_{n+1} = (I + H/2) dx_{n+1/2} and dx_n = (I - H/2) dx_{n+1/2}
    const double half_trace = 0.5 * (H[0][0] + H[1][1]), quarter = 0.25 * (H[0][0] * H[1][1] - H[0][1] * H[1][0]);
    log_volume = ok ? ::log1p(quarter + half_trace) - ::log1p(quarter - half_trace) + ::log1p(0.5 * hoop) - ::log1p(-0.5 * hoop) : 0.0;
    spin = 0.5 * (H[1][0] - H[0][1]);
    const double q = 1 + 0.25 * spin * spin;
    cosine = (1 - 0.25 * spin * spin) / q;
    sine = spin / q;
    half_cosine = 1 / std::sqrt(q);
    half_sine = 0.5 * spin * half_cosine;
    increment[0] = H[0][0];
    increment[1] = H[1][1];
    increment[2] = hoop;
    increment[3] = H[0][1] + H[1][0];
    const double shift = (log_volume - (increment[0] + increment[1] + increment[2])) / 3;
    for (int i = 0; i < 3; ++i) increment[i] += shift;
    turn_half(increment);
  }

  KOKKOS_INLINE_FUNCTION void strain(double (&e)[4]) const {
    for (int i = 0; i < 4; ++i) e[i] = increment[i];
  }

  /// From the axes of the midpoint to those of the end.
  KOKKOS_INLINE_FUNCTION void turn_half(double (&e)[4]) const {
    const double cc = half_cosine * half_cosine, ss = half_sine * half_sine, cs = half_cosine * half_sine;
    const double xx = cc * e[0] - cs * e[3] + ss * e[1], yy = ss * e[0] + cs * e[3] + cc * e[1];
    e[3] = 2 * cs * (e[0] - e[1]) + (cc - ss) * e[3];
    e[0] = xx;
    e[1] = yy;
  }

  /// Variation of the strain increment and of the rotation angle for a displacement N_b in direction j.
  KOKKOS_INLINE_FUNCTION void variation(int b, int j, double (&de)[4], double& dtheta) const {
    // dH = (I - H/2) d(du)/dx_mid, exactly: the midpoint moves with half the variation.
    const double a0 = (j == 0 ? 1.0 : 0.0) - 0.5 * H[0][j], a1 = (j == 1 ? 1.0 : 0.0) - 0.5 * H[1][j];
    de[0] = a0 * g[b][0];
    de[1] = a1 * g[b][1];
    de[2] = j == 0 ? (1 - 0.5 * hoop) * shape_over_r[b] : 0.0;
    de[3] = a0 * g[b][1] + a1 * g[b][0];
    const double volume = g_end[b][j] + (j == 0 ? shape_over_r_end[b] : 0.0);  // d ln J
    const double shift = (volume - (de[0] + de[1] + de[2])) / 3;
    for (int i = 0; i < 3; ++i) de[i] += shift;
    dtheta = 0.5 * (a1 * g[b][0] - a0 * g[b][1]) / (1 + 0.25 * spin * spin);
    turn_half(de);
    const double half = 0.5 * dtheta;
    de[0] -= half * increment[3];
    de[1] += half * increment[3];
    de[3] += 2 * half * (increment[0] - increment[1]);
  }
};

/// R S R^T of a symmetric tensor xx yy zz yz xz xy for the in-plane rotation (cosine, sine).
KOKKOS_INLINE_FUNCTION void rotate_symmetric(const double* s, double cosine, double sine, double* out) {
  const double cc = cosine * cosine, ss = sine * sine, cs = cosine * sine;
  out[0] = cc * s[0] - 2 * cs * s[5] + ss * s[1];
  out[1] = ss * s[0] + 2 * cs * s[5] + cc * s[1];
  out[2] = s[2];
  out[3] = sine * s[4] + cosine * s[3];
  out[4] = cosine * s[4] - sine * s[3];
  out[5] = cs * (s[0] - s[1]) + (cc - ss) * s[5];
}

}  // namespace mudline
