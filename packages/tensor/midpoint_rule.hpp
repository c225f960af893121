#pragma once

#include <Kokkos_Core.hpp>

#include <cmath>

namespace mudline {

/// Objective increment of a motion in the plane (Hughes and Winget 1980) from its gradient on the midpoint
/// configuration, H = d(Delta u)/d x_{n+1/2}, and the hoop strain Delta u_r/r_{n+1/2}: strain = sym H, rotation by the
/// angle 2 atan(w/2) with the spin w = (H_yx - H_xy)/2. A pure rotation gives no strain. The trace of the strain
/// increment is replaced by ln J, so that the skeleton's volume strain is the one that the void ratio and the pore
/// water see, whatever the size of the step. sym H has the axes of the midpoint: it is turned on by half the angle to
/// those of the end, where stress and state are. Without that the stress would be of first order only in the step where
/// strain and rotation come together.
struct MidpointRule {
  double spin;                    // w [-]
  double cosine, sine;            // of the rotation
  double half_cosine, half_sine;  // of half of it
  double increment[4];            // strain xx yy zz(hoop) xy (engineering shear), axes of the end
  double log_volume;              // ln J, J = dv_{n+1} / dv_n

  /// `valid`: the configurations are not inverted; otherwise ln J is 0 and the increment means nothing.
  KOKKOS_INLINE_FUNCTION void evaluate(const double (&H)[2][2], double hoop, bool valid) {
    // exactly: dx_{n+1} = (I + H/2) dx_{n+1/2} and dx_n = (I - H/2) dx_{n+1/2}
    const double half_trace = 0.5 * (H[0][0] + H[1][1]), quarter = 0.25 * (H[0][0] * H[1][1] - H[0][1] * H[1][0]);
    log_volume = valid ? ::log1p(quarter + half_trace) - ::log1p(quarter - half_trace) + ::log1p(0.5 * hoop) -
                             ::log1p(-0.5 * hoop)
                       : 0.0;
    spin = 0.5 * (H[1][0] - H[0][1]);
    const double q = 1 + 0.25 * spin * spin;
    cosine = (1 - 0.25 * spin * spin) / q;
    sine = spin / q;
    half_cosine = 1 / ::sqrt(q);
    half_sine = 0.5 * spin * half_cosine;
    increment[0] = H[0][0];
    increment[1] = H[1][1];
    increment[2] = hoop;
    increment[3] = H[0][1] + H[1][0];
    const double shift = (log_volume - (increment[0] + increment[1] + increment[2])) / 3;
    for (int i = 0; i < 3; ++i) increment[i] += shift;
    turn_half(increment);
  }

  /// A strain from the axes of the midpoint to those of the end.
  KOKKOS_INLINE_FUNCTION void turn_half(double (&e)[4]) const {
    const double cc = half_cosine * half_cosine, ss = half_sine * half_sine, cs = half_cosine * half_sine;
    const double xx = cc * e[0] - cs * e[3] + ss * e[1], yy = ss * e[0] + cs * e[3] + cc * e[1];
    e[3] = 2 * cs * (e[0] - e[1]) + (cc - ss) * e[3];
    e[0] = xx;
    e[1] = yy;
  }
};

}  // namespace mudline
