#include "ale/closest_on_side.hpp"

#include <algorithm>
#include <cmath>

#include "discretisation/element_map.hpp"
#include "geometry/closest_on_curve.hpp"

namespace mudline {

namespace {

/// A line of two or three nodes.
struct Line {
  int count;
  Point node[3];

  CurvePoint<3> at(double t) const {
    double N[3], dN[3];
    evaluate_line(count, t, N, dN);
    CurvePoint<3> result{};
    for (int a = 0; a < count; ++a) {
      result.x += N[a] * node[a];
      result.d += dN[a] * node[a];
    }
    if (count == 3) result.dd = node[0] + node[1] - 2 * node[2];
    return result;
  }
};

ClosestOnSide closest_on_line(const Line& line, const Point& x, double least) {
  constexpr int steps = 8;  // a parabola has no more than three places where its distance is stationary
  const CurveBracket bracket = around_closest_sample(-1, 1, steps, [&](int, double t) {
    const Point offset = x - line.at(t).x;
    return dot(offset, offset);
  });
  const double near = std::sqrt(bracket.square);
  // Distances change by at most the arc length, which even on a strongly curved line is less than twice the chord.
  if (near - 2 * length(line.node[1] - line.node[0]) / steps > least) return {{bracket.start, 0}, near, false};
  const double t = closest_on_curve([&](double at) { return line.at(at); }, x, bracket);
  return {{t, 0}, length(x - line.at(t).x), std::abs(t) < 1};
}

/// A face of elements in space.
struct Face {
  const CurvedSide& side;
  const Positions& x;

  /// Goes from the centre to the closest point by the Gauss-Newton method, because faces are nearly flat; on others a
  /// step that leads away is halved. False where the closest point is not inside.
  bool closest_inside(const Point& point, ClosestOnSide& best) const {
    const auto centre = cell_centre(side.shape);
    Vec<double, 2> place{centre[0], centre[1]}, step{};
    for (int k = 0; k < 60; ++k) {
      const SideMap<3> map = face_map(side, x, place);
      const Point off = point - map.x;
      if (length(off) > best.distance && length(step) > 1e-6) {
        step = 0.5 * step;
        place -= step;
        continue;
      }
      best.distance = length(off);
      const double a = dot(map.along[0], map.along[0]), b = dot(map.along[0], map.along[1]),
                   c = dot(map.along[1], map.along[1]), p = dot(map.along[0], off), q = dot(map.along[1], off),
                   det = a * c - b * b;
      if (!(outside_cell(side.shape, place.data()) < 0.5) || !(det > 0)) return false;  // it is on another face
      step = {(c * p - b * q) / det, (a * q - b * p) / det};
      place += step;
      if (std::abs(step[0]) + std::abs(step[1]) <= 1e-14) break;
    }
    best = {place, length(point - face_map(side, x, place).x), true};
    return outside_cell(side.shape, place.data()) <= 0;
  }
  /// The closest point of an edge, if it is closer.
  void approach_edge(int edge, const Point& point, double least, ClosestOnSide& best) const {
    const auto [a, b] = edge_corners(side.shape, edge);
    const int count = order(side.shape) + 1, middle = count == 3 ? num_corners(side.shape) + edge : a;
    const Line line{count, {x[side.nodes[a]], x[side.nodes[b]], x[side.nodes[middle]]}};
    const ClosestOnSide there = closest_on_line(line, point, std::min(least, best.distance));
    if (there.distance >= best.distance) return;
    const auto from = reference_node(side.shape, a), to = reference_node(side.shape, b);
    const auto along = [&](int k) { return 0.5 * (1 - there.place[0]) * from[k] + 0.5 * (1 + there.place[0]) * to[k]; };
    best = {{along(0), along(1)}, there.distance, false};
  }
};

}  // namespace

SideMap<3> face_map(const CurvedSide& face, const Positions& x, const FacePlace& place) {
  double N[9], dN[18];
  evaluate_shape(face.shape, place.data(), N, dN);
  SideMap<3> map;
  map.compute(num_nodes(face.shape), N, dN, [&](int a, int i) { return x[face.nodes[a]][i]; });
  return map;
}

ClosestOnSide closest_on_side(const CurvedSide& side, const Positions& x, const Point& point, double least) {
  const auto& [shape, nodes] = side;
  if (dimension(shape) == 1) {
    const int count = order(shape) + 1;
    return closest_on_line({count, {x[nodes[0]], x[nodes[1]], x[nodes[count - 1]]}}, point, least);
  }
  double size = 0;  // a curved face is within twice this distance from its first node
  for (int a = 1; a < num_nodes(shape); ++a) size = std::max(size, length(x[nodes[a]] - x[nodes[0]]));
  const double off = length(point - x[nodes[0]]);
  if (off - 2 * size > least) return {{}, off, false};
  const Face face{side, x};
  ClosestOnSide best;
  if (face.closest_inside(point, best)) return best;
  best = {};
  for (int edge = 0; edge < num_edges(shape); ++edge) face.approach_edge(edge, point, least, best);
  return best;
}

}  // namespace mudline
