#include "geometry/rounded_box.hpp"

#include <algorithm>
#include <cmath>

#include "core/pi.hpp"
#include "tensor/vec.hpp"

namespace mudline {

RoundedBox::RoundedBox(const Point& lengths, double fillet_radius) : radius_(fillet_radius) {
  for (int i = 0; i < 3; ++i) {
    core_[i] = std::max(0.0, 0.5 * lengths[i] - fillet_radius);
    bounds_.low[i] = -0.5 * lengths[i];
    bounds_.high[i] = 0.5 * lengths[i];
  }
}

SurfaceFoot RoundedBox::closest(const Point& x) const {
  SurfaceFoot result{};
  Point sign{}, beyond{};  // beyond: from the core to the point where that is outside of it
  int nearest = 0;
  double depth = 0;
  for (int i = 0; i < 3; ++i) {
    sign[i] = std::copysign(1.0, x[i]);
    const double over = std::abs(x[i]) - core_[i];
    beyond[i] = std::max(0.0, over);
    if (i > 0 && over <= depth) continue;
    depth = over;
    nearest = i;
  }
  const double distance = length(beyond);
  if (distance > 0) {
    result.gap = distance - radius_;
    for (int i = 0; i < 3; ++i) result.normal[i] = sign[i] * beyond[i] / distance;
    const bool centre = distance <= 1e-9 * radius_;
    if (!centre)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          if (beyond[i] > 0 && beyond[j] > 0)
            result.turning[i][j] = ((i == j ? 1.0 : 0.0) - result.normal[i] * result.normal[j]) / distance;
  } else {
    result.gap = depth - radius_;
    result.normal[nearest] = sign[nearest];
    if (result.gap == 0) {  // a sharp edge or corner
      int sides = 0;
      for (int i = 0; i < 3; ++i) sides += std::abs(x[i]) == core_[i];
      for (int i = 0; i < 3; ++i) result.normal[i] = std::abs(x[i]) == core_[i] ? sign[i] / std::sqrt(sides) : 0.0;
    }
  }
  result.foot = x - result.gap * result.normal;
  return result;
}

SurfaceTriangles RoundedBox::triangles(double chord_error) const {
  // a sphere cut at its meridians and its equator and pulled apart by the core; a piece over the angle 2 a of both
  // directions deviates by 2 radius (1 - cos a)
  const double half = radius_ > 0 ? std::acos(std::max(0.0, 1 - 0.5 * chord_error / radius_)) : pi;
  const int steps = std::max(1, static_cast<int>(std::ceil(0.25 * pi / half)));
  const int columns = 4 * (steps + 1), rows = 2 * (steps + 1);
  SurfaceTriangles result;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const int quadrant = column / (steps + 1);
      const double around = 0.5 * pi * (quadrant + static_cast<double>(column % (steps + 1)) / steps);
      const double up = 0.5 * pi * (static_cast<double>(row % (steps + 1)) / steps - (row <= steps ? 1 : 0));
      result.points.push_back(
          {(quadrant == 0 || quadrant == 3 ? 1 : -1) * core_[0] + radius_ * std::cos(up) * std::cos(around),
           (quadrant <= 1 ? 1 : -1) * core_[1] + radius_ * std::cos(up) * std::sin(around),
           (row <= steps ? -1 : 1) * core_[2] + radius_ * std::sin(up)});
    }
  for (int row = 0; row + 1 < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const int next = (column + 1) % columns, low = row * columns, high = low + columns;
      result.facets.push_back({low + column, low + next, high + next});
      result.facets.push_back({low + column, high + next, high + column});
    }
  const int corner = steps + 1, top = (rows - 1) * columns;
  result.facets.push_back({0, 2 * corner, corner});
  result.facets.push_back({0, 3 * corner, 2 * corner});
  result.facets.push_back({top, top + corner, top + 2 * corner});
  result.facets.push_back({top, top + 2 * corner, top + 3 * corner});
  return welded(result, 1e-9 * bounds_.extent());
}

SolidMoments RoundedBox::moments() const {
  // by the directions in which a point is beyond the core; these make an orthant of a ball of 0 to 3 dimensions
  const double r = radius_;
  const double volume[4] = {1, r, pi * r * r / 4, pi * r * r * r / 6};
  const double mean[4] = {0, r / 2, 4 * r / (3 * pi), 3 * r / 8};  // of a coordinate
  const double mean_square[4] = {0, r * r / 3, r * r / 4, r * r / 5};
  SolidMoments result;
  for (int set = 0; set < 8; ++set) {
    const int count = (set & 1) + (set >> 1 & 1) + (set >> 2 & 1);
    double part = 8 * volume[count];
    for (int i = 0; i < 3; ++i)
      if (!(set >> i & 1)) part *= core_[i];
    result.volume += part;
    for (int i = 0; i < 3; ++i)
      result.second[i][i] +=
          part * (set >> i & 1 ? core_[i] * core_[i] + 2 * core_[i] * mean[count] + mean_square[count]
                               : core_[i] * core_[i] / 3);
  }
  return result;
}

}  // namespace mudline
