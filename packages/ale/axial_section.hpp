#pragma once

#include <cmath>

#include "tensor/sym6.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// The axisymmetric section through a place in space. The axis of symmetry is the z axis of space; in the section x is
/// the distance from it and y the height.
class AxialSection {
 public:
  explicit AxialSection(const Point& place) {
    const double radius = std::hypot(place[0], place[1]);
    if (radius > 0) cosine_ = place[0] / radius, sine_ = place[1] / radius;
  }
  /// The place in the section [m]: (radius, height, 0).
  static Point place(const Point& in_space) { return {std::hypot(in_space[0], in_space[1]), in_space[2], 0}; }

  /// A vector of the section as one of space.
  Point vector(const Point& v) const { return {cosine_ * v[0], sine_ * v[0], v[1]}; }
  /// A symmetric tensor of the section (radial, axial, hoop, and the shear of the section) as one of space; both in the
  /// order of sym6.
  void tensor(const double* in_section, double* in_space) const {
    const double axes[9] = {cosine_, 0, sine_, sine_, 0, -cosine_, 0, 1, 0};  // row-major; columns: the section's axes
    sym6::rotate(axes, in_section, in_space);
  }

 private:
  double cosine_ = 1, sine_ = 0;
};

}  // namespace mudline
