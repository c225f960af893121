#pragma once

#include "tensor/sym6.hpp"

namespace mudline {

/// Shape of a strength surface in the deviatoric plane, sqrt(J2) K(S) = const, with S the Lode measure of sym6 (-1 in
/// triaxial compression). Mohr-Coulomb: with sin 3theta = -S, theta = 30 deg in triaxial compression,
///     K = cos theta - sin theta sin(phi)/sqrt(3)                      for |theta| <= theta_T
///     K = A + B sin 3theta + C sin^2 3theta                           beyond, on either side
/// value, slope and curvature continuous at theta_T: Abbo, Lyamin, Sloan & Hambleton 2011, IJSS 48:3001. K exceeds the
/// exact value at the corners, so strength is lost there: 0.7 % in triaxial compression for phi = 30 deg, theta_T = 29.
/// sin(phi) = 0 is Tresca, sin(phi) = 1 is Rankine: sigma_1 = mean stress + sqrt(J2) K.
struct LodeShape {
  bool circle = true;       // K = 1
  double sine = 0.0;        // sin(phi)
  double edge = 1.0;        // sin(3 theta_T)
  double a[2], b[2], c[2];  // [0]: sin 3theta > 0

  static LodeShape mohr_coulomb(double sine, double transition_degrees) {
    LodeShape r;
    r.circle = false;
    r.sine = sine;
    const double t = transition_degrees * 0.017453292519943295, root3 = ::sqrt(3.0), c3 = ::cos(3 * t),
                 s3 = ::sin(3 * t);
    r.edge = s3;
    for (int side = 0; side < 2; ++side) {
      const double sg = side == 0 ? 1.0 : -1.0;
      const double q1 = ::cos(t) - sg * sine * ::sin(t) / root3, q2 = sg * ::sin(t) + sine * ::cos(t) / root3;
      const double d = 18 * c3 * c3 * c3;
      r.c[side] = (-c3 * q1 - 3 * sg * s3 * q2) / d;
      r.b[side] = (sg * ::sin(6 * t) * q1 - 6 * ::cos(6 * t) * q2) / d;
      r.a[side] = q1 - sg * r.b[side] * s3 - r.c[side] * s3 * s3;
    }
    return r;
  }
};

/// K and its first two derivatives with respect to S.
struct LodeValue {
  double k = 1.0, slope = 0.0, curvature = 0.0;
};

/// The Lode angle of one stress, for evaluating shapes with the same transition angle.
struct LodeAngle {
  double sine3;                  // sin 3theta = -S
  double sine, cosine, cosine3;  // of theta and 3theta, between the transitions

  /// `edge`: sin(3 theta_T) of the shapes.
  KOKKOS_INLINE_FUNCTION LodeAngle(double s, double edge) : sine3(-s), sine(0), cosine(1), cosine3(1) {
    if (!(::fabs(sine3) <= edge)) return;
    const double theta = ::asin(sine3) / 3.0;
    sine = ::sin(theta);
    cosine = ::sqrt(1.0 - sine * sine);
    cosine3 = ::sqrt(1.0 - sine3 * sine3);
  }

  KOKKOS_INLINE_FUNCTION LodeValue operator()(const LodeShape& shape) const {
    LodeValue r;
    if (shape.circle) return r;
    if (::fabs(sine3) <= shape.edge) {
      const double friction = shape.sine * 0.57735026918962576;
      r.k = cosine - friction * sine;
      const double by_theta = -sine - friction * cosine, rate = 1.0 / (3.0 * cosine3);  // dtheta/d sin 3theta
      r.slope = -by_theta * rate;
      r.curvature = rate * (-r.k * rate + by_theta * sine3 / (cosine3 * cosine3));
    } else {
      const int side = sine3 > 0.0 ? 0 : 1;
      r.k = shape.a[side] + sine3 * (shape.b[side] + sine3 * shape.c[side]);
      r.slope = -(shape.b[side] + 2.0 * sine3 * shape.c[side]);
      r.curvature = 2.0 * shape.c[side];
    }
    return r;
  }
};

}  // namespace mudline
