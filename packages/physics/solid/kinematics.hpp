#pragma once

#include <cmath>

#include "physics/element.hpp"
#include "tensor/midpoint_rule.hpp"

namespace mudline {

/// The midpoint rule between the committed configuration x_n and x_{n+1} at a point of an element, and its variation.
/// Everything is built from the increments of displacement, not from differences of positions: strains of 1e-12 would
/// drown in the rounding of coordinates.
template <int N>
struct IncrementKinematics : MidpointRule {
  double g[N][2];                               // dN/dx at the midpoint [1/m]
  double g_end[N][2];                           // dN/dx at n+1 [1/m]
  double shape_over_r[N], shape_over_r_end[N];  // N_a / r at the midpoint and at n+1 (axisymmetric), else 0
  double H[2][2], hoop;
  bool ok;

  /// du: the nodes' displacement of the step, x_end - x_old without its rounding.
  KOKKOS_INLINE_FUNCTION void compute(const double (&x_old)[N][2], const double (&x_end)[N][2],
                                      const double (&du)[N][2], const double* dN, const double* shape,
                                      bool axisymmetric) {
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
    evaluate(H, hoop, ok);
  }

  KOKKOS_INLINE_FUNCTION void strain(double (&e)[4]) const {
    for (int i = 0; i < 4; ++i) e[i] = increment[i];
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
