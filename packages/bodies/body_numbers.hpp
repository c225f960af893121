#pragma once

#include "tensor/rotation.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// The most unknowns that a body has.
constexpr int body_directions = 6;

/// What a body's balance is made of: numbers with their derivatives by the body's unknowns.
using BodyNumber = Dual<body_directions>;
using BodyVector = Vec<BodyNumber, 3>;

inline BodyVector constant_vector(const Point& x) { return {BodyNumber(x[0]), BodyNumber(x[1]), BodyNumber(x[2])}; }
inline Point plain_vector(const BodyVector& x) { return {x[0].v, x[1].v, x[2].v}; }

/// The axes of a body in space; between two instants, the means of those at both, which are shorter.
struct BodyAxes {
  BodyVector axis[3];

  BodyAxes() : BodyAxes(Rotation()) {}
  explicit BodyAxes(const Rotation& turn) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) axis[i][j] = BodyNumber(turn.matrix[j][i]);
  }
  /// From components along the axes, and to them.
  BodyVector outward(const BodyVector& v) const { return axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2]; }
  BodyVector inward(const BodyVector& v) const { return {dot(axis[0], v), dot(axis[1], v), dot(axis[2], v)}; }

  /// These axes turned on by an increment along them, see Rotation::by_increment.
  BodyAxes turned_on(const BodyVector& increment) const {
    const BodyNumber factor = 1.0 / (1.0 + 0.25 * dot(increment, increment));
    BodyAxes result;
    for (int i = 0; i < 3; ++i) {
      BodyVector unit = BodyVector::zero();
      unit[i] = BodyNumber(1.0);
      const BodyVector across = cross(increment, unit);
      result.axis[i] = outward(unit + (across + cross(increment, across) * 0.5) * factor);
    }
    return result;
  }
  /// share times these axes, the rest of the others.
  BodyAxes mixed(double share, const BodyAxes& other) const {
    BodyAxes result;
    for (int i = 0; i < 3; ++i) result.axis[i] = axis[i] * share + other.axis[i] * (1 - share);
    return result;
  }
};

}  // namespace mudline
