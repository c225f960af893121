#pragma once

#include <array>

#include "core/function.hpp"
#include "tensor/mat.hpp"

namespace mudline {

/// The volume of a solid and its moments about the origin of its frame; those of solids side by side add up.
struct SolidMoments {
  double volume = 0;        // [m3]
  Point first{};            // int x dV [m4]
  Mat<double, 3> second{};  // int x x^T dV [m5]

  Point centroid() const;
  /// int (|r|^2 1 - r r^T) dV [m5], r from the centroid: the inertia tensor of a solid of density 1 kg/m3.
  std::array<Point, 3> inertia() const;

  /// Adds `factor` times the other.
  void add(const SolidMoments& other, double factor);
  /// Adds `factor` times a block of these side lengths [m], along the axes, around a centre.
  void add_block(const Point& centre, const Point& lengths, double factor);
  /// Adds what the divergence theorem makes of a piece of the surface: a point of it and its area vector [m2], which
  /// points out of the solid.
  void add_side(const Point& at, const Point& area);
  /// The same solid after it has been turned by `rotation` about the origin and then shifted [m].
  SolidMoments placed(const Mat<double, 3>& rotation, const Point& shift) const;
};

}  // namespace mudline
