#include <algorithm>
#include <cmath>

#include "geometry/contour.hpp"

namespace mudline {

namespace {

constexpr double negligible = 1e-12;  // relative length below which a piece is left out

struct Polygon {
  const std::vector<PlanePoint>& points;
  const std::vector<double>& radii;
  bool half;

  int lines() const { return static_cast<int>(points.size()) - 1; }
  PlanePoint direction(int line) const {
    const double l = length(line);
    return {(points[line + 1][0] - points[line][0]) / l, (points[line + 1][1] - points[line][1]) / l};
  }
  double length(int line) const {
    return std::hypot(points[line + 1][0] - points[line][0], points[line + 1][1] - points[line][1]);
  }
  /// Angle [rad] by which the direction turns at a corner, positive counter-clockwise (convex); 0 at an open end.
  double turn(int corner) const {
    if (corner == lines()) return 0;
    const PlanePoint out = direction(corner);
    if (corner == 0) return half ? 2 * std::atan2(out[1], out[0]) : 0.0;
    const PlanePoint in = direction(corner - 1);
    return std::atan2(in[0] * out[1] - in[1] * out[0], in[0] * out[0] + in[1] * out[1]);
  }
  /// Length of the line that the fillet at its corner replaces.
  double tangent_length(int corner) const { return radii[corner] * std::tan(0.5 * std::abs(turn(corner))); }
};

/// The arc of the fillet at a corner. On the axis only its second half exists.
std::shared_ptr<const ContourPiece> fillet(const Polygon& polygon, int corner) {
  const double turn = polygon.turn(corner), radius = polygon.radii[corner], sign = turn < 0 ? -1 : 1;
  const PlanePoint out = polygon.direction(corner), at = polygon.points[corner];
  const double along = polygon.tangent_length(corner);
  // the centre lies on the left of a convex corner, one radius beside the line that leaves it
  const PlanePoint centre{at[0] + along * out[0] - sign * radius * out[1],
                          at[1] + along * out[1] + sign * radius * out[0]};
  const double end = std::atan2(-sign * out[0], sign * out[1]);  // from the centre to where the outgoing line starts
  const double sweep = corner == 0 ? 0.5 * turn : turn;
  return std::make_shared<ArcPiece>(corner == 0 ? PlanePoint{0.0, centre[1]} : centre, radius, end - sweep, sweep);
}

}  // namespace

int overfull_line(const std::vector<PlanePoint>& points, const std::vector<double>& radii, ContourExtent extent) {
  const Polygon polygon{points, radii, extent == ContourExtent::half};
  for (int i = 0; i < polygon.lines(); ++i)
    if (polygon.tangent_length(i) + polygon.tangent_length(i + 1) > polygon.length(i) * (1 + negligible)) return i;
  return -1;
}

Contour rounded_polygon(const std::vector<PlanePoint>& points, const std::vector<double>& radii, ContourExtent extent) {
  const Polygon polygon{points, radii, extent == ContourExtent::half};
  const int n = polygon.lines();
  const bool on_axis = polygon.half && std::abs(points[n][0]) <= negligible * polygon.length(n - 1);
  const bool closed = on_axis || (!polygon.half && points.front() == points.back());
  std::vector<std::shared_ptr<const ContourPiece>> pieces;
  for (int i = 0; i < n; ++i) {
    if (polygon.tangent_length(i) > negligible * polygon.length(i)) pieces.push_back(fillet(polygon, i));
    const double before = polygon.tangent_length(i), after = polygon.tangent_length(i + 1);
    if (polygon.length(i) - before - after <= negligible * polygon.length(i)) continue;
    const PlanePoint d = polygon.direction(i);
    pieces.push_back(
        std::make_shared<LinePiece>(PlanePoint{points[i][0] + before * d[0], points[i][1] + before * d[1]},
                                    PlanePoint{points[i + 1][0] - after * d[0], points[i + 1][1] - after * d[1]},
                                    i == 0 && !polygon.half && !closed, i == n - 1 && !closed));
  }
  return Contour(std::move(pieces), extent);
}

}  // namespace mudline
