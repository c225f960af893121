#pragma once

#include <cmath>

#include "tensor/mat.hpp"

namespace mudline {

/// A rotation of space by its matrix.
struct Rotation {
  Mat<double, 3> matrix{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

  /// About the direction of the vector, right-handed, by its length [rad].
  static Rotation by(const Point& vector) {
    const double angle = length(vector);
    const Point n = angle > 0 ? 1 / angle * vector : Point{0, 0, 1};
    const double c = std::cos(angle), s = std::sin(angle);
    const Mat<double, 3> skew = {{{0, -n[2], n[1]}, {n[2], 0, -n[0]}, {-n[1], n[0], 0}}};
    Rotation result;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) result.matrix[i][j] = (i == j ? c : 0.0) + s * skew[i][j] + (1 - c) * n[i] * n[j];
    return result;
  }

  /// About the direction of the vector by twice the arc tangent of half its length: Cayley's map. Over a step the mean
  /// of the spins at its ends, along the body's axes, is this vector over the step's length (Simo and Wong 1991).
  static Rotation by_increment(const Point& vector) {
    const double half = 0.5 * length(vector);
    return by(half > 0 ? std::atan(half) / half * vector : vector);
  }

  /// x turned, and turned back.
  KOKKOS_INLINE_FUNCTION Point operator()(const Point& x) const { return matrix * x; }
  KOKKOS_INLINE_FUNCTION Point back(const Point& x) const { return transposed(matrix) * x; }

  /// This rotation after `first`.
  KOKKOS_INLINE_FUNCTION Rotation operator*(const Rotation& first) const { return {matrix * first.matrix}; }
  KOKKOS_INLINE_FUNCTION Rotation inverse() const { return {transposed(matrix)}; }

  /// What by() makes this rotation of, at most pi long.
  Point vector() const {
    Point axis;
    const double cosine = half_angle(axis), sine = length(axis);
    return sine > 0 ? 2 * std::atan2(sine, cosine) / sine * axis : Point{};
  }
  /// What by_increment() makes this rotation of; infinite of half a turn.
  Point increment() const {
    Point axis;
    const double cosine = half_angle(axis);
    return 2 / cosine * axis;
  }

 private:
  /// The rotation's quaternion, up to a positive factor: what goes with the cosine of half the angle, and with its sine
  /// times the axis.
  double half_angle(Point& axis) const {
    const auto& m = matrix;
    // the quaternion's largest component first: it is never small
    double q[4] = {1 + m[0][0] + m[1][1] + m[2][2], 1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2],
                   1 - m[0][0] - m[1][1] + m[2][2]};
    int largest = 0;
    for (int k = 1; k < 4; ++k)
      if (q[k] > q[largest]) largest = k;
    const double products[4][4] = {{q[0], m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]},
                                   {m[2][1] - m[1][2], q[1], m[1][0] + m[0][1], m[0][2] + m[2][0]},
                                   {m[0][2] - m[2][0], m[1][0] + m[0][1], q[2], m[2][1] + m[1][2]},
                                   {m[1][0] - m[0][1], m[0][2] + m[2][0], m[2][1] + m[1][2], q[3]}};
    const double sign = products[largest][0] < 0 ? -1 : 1;
    axis = {sign * products[largest][1], sign * products[largest][2], sign * products[largest][3]};
    return sign * products[largest][0];
  }
};

}  // namespace mudline
