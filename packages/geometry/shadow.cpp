#include "geometry/shadow.hpp"

#include <algorithm>
#include <cmath>

namespace mudline {

namespace {

double turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Corners of the convex hull, counter-clockwise (Andrew's monotone chains).
std::vector<PlanePoint> hull_of(std::vector<PlanePoint> points) {
  std::sort(points.begin(), points.end());
  std::vector<PlanePoint> hull;
  const auto add_chain = [&](auto first, auto last) {
    const std::size_t start = hull.size();
    for (auto p = first; p != last; ++p) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), *p) <= 0) hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();  // it begins the other chain
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

/// Extent of the hull along a unit vector.
double extent(const std::vector<PlanePoint>& hull, const PlanePoint& along) {
  double low = 1e300, high = -1e300;
  for (const PlanePoint& x : hull) {
    const double at = x[0] * along[0] + x[1] * along[1];
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return high - low;
}

}  // namespace

Shadow shadow_in_space(const std::vector<Point>& points, const Point& direction) {
  const Point d = unit(direction);
  Point axis{};
  axis[std::abs(d[0]) < 0.7 ? 0 : 1] = 1;
  const Point first = unit(cross(d, axis)), second = cross(d, first);
  std::vector<PlanePoint> seen;
  for (const Point& x : points) seen.push_back({dot(first, x), dot(second, x)});
  const std::vector<PlanePoint> hull = hull_of(std::move(seen));
  // the narrowest pair of parallel lines has an edge of the hull on one of them
  Shadow result{1e300, 0};
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const PlanePoint &a = hull[i], &b = hull[(i + 1) % hull.size()];
    const double edge = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (!(edge > 0)) continue;
    const PlanePoint along{(b[0] - a[0]) / edge, (b[1] - a[1]) / edge};
    const double width = extent(hull, {-along[1], along[0]});
    if (width < result.width) result = {width, extent(hull, along)};
  }
  return result.width < 1e300 ? result : Shadow{};
}

double extent_along(const std::vector<Point>& points, const Point& direction) {
  const Point d = unit(direction);
  double low = 1e300, high = -1e300;
  for (const Point& x : points) {
    low = std::min(low, dot(d, x));
    high = std::max(high, dot(d, x));
  }
  return high - low;
}

}  // namespace mudline
