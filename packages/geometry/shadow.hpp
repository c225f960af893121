#pragma once

#include <vector>

#include "tensor/vec.hpp"

namespace mudline {

/// What a body covers, seen along a direction: the least distance of two parallel lines with all of it between them,
/// and its extent along those lines [m]. Of a circle both are the diameter; of a plate its two sides.
struct Shadow {
  double width = 0, length = 0;
};

/// The shadow of a body whose surface has these points (at least one), cast along a direction of any length but 0. It
/// is that of their convex hull, so it is a little smaller than that of a round body.
Shadow shadow_in_space(const std::vector<Point>& points, const Point& direction);

/// Largest less smallest coordinate [m] of the points along a direction of any length but 0.
double extent_along(const std::vector<Point>& points, const Point& direction);

}  // namespace mudline
