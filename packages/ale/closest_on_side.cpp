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
  double near = 1e300;
  const CurveBracket bracket = around_closest_sample(-1, 1, steps, [&](int i) {
    const Point offset = x - line.at(-1 + 2.0 * i / steps).x;
    const double square = dot(offset, offset);
    near = std::min(near, square);
    return square;
  });
  ClosestOnSide result{{bracket.start, 0}, std::sqrt(near), false};
  // Distances change by at most the arc length, which even on a strongly curved line is less than twice the chord.
  if (result.distance - 2 * length(line.node[1] - line.node[0]) / steps > least) return result;
  const double t = closest_on_curve([&](double at) { return line.at(at); }, x, bracket);
  return {{t, 0}, length(x - line.at(t).x), std::abs(t) < 1};
}

/// A face of elements in space.
struct Face {
  CellShape shape;
  const Point* nodes;

  /// From a place to x, and the tangents there.
  struct Offset {
    Point off, along[2];
  };
  Offset offset(const Vec<double, 2>& place, const Point& x) const {
    double N[9], dN[18];
    evaluate_shape(shape, place.data(), N, dN);
    Offset result{x, {}};
    for (int a = 0; a < num_nodes(shape); ++a) {
      result.off -= N[a] * nodes[a];
      for (int i = 0; i < 2; ++i) result.along[i] += dN[2 * a + i] * nodes[a];
    }
    return result;
  }
  /// Goes from the centre to the closest point by the Gauss-Newton method, because faces are nearly flat; on others a
  /// step that leads away is halved. False where the closest point is not inside.
  bool closest_inside(const Point& x, ClosestOnSide& best) const {
    const auto centre = cell_centre(shape);
    Vec<double, 2> place{centre[0], centre[1]}, step{};
    for (int k = 0; k < 60; ++k) {
      const Offset at = offset(place, x);
      if (length(at.off) > best.distance && length(step) > 1e-6) {
        step = 0.5 * step;
        place -= step;
        continue;
      }
      best.distance = length(at.off);
      const double a = dot(at.along[0], at.along[0]), b = dot(at.along[0], at.along[1]),
                   c = dot(at.along[1], at.along[1]), p = dot(at.along[0], at.off), q = dot(at.along[1], at.off),
                   det = a * c - b * b;
      if (!(outside_cell(shape, place.data()) < 0.5) || !(det > 0)) return false;  // it is on another face
      step = {(c * p - b * q) / det, (a * q - b * p) / det};
      place += step;
      if (std::abs(step[0]) + std::abs(step[1]) <= 1e-14) break;
    }
    best = {place, length(offset(place, x).off), true};
    return outside_cell(shape, place.data()) <= 0;
  }
  /// The closest point of an edge, if it is closer.
  void approach_edge(int edge, const Point& x, double least, ClosestOnSide& best) const {
    const auto [a, b] = edge_corners(shape, edge);
    const int count = order(shape) + 1;
    const Line line{count, {nodes[a], nodes[b], nodes[count == 3 ? num_corners(shape) + edge : a]}};
    const ClosestOnSide there = closest_on_line(line, x, std::min(least, best.distance));
    if (there.distance >= best.distance) return;
    const auto from = reference_node(shape, a), to = reference_node(shape, b);
    const auto along = [&](int k) { return 0.5 * (1 - there.place[0]) * from[k] + 0.5 * (1 + there.place[0]) * to[k]; };
    best = {{along(0), along(1)}, there.distance, false};
  }
};

}  // namespace

ClosestOnSide closest_on_side(CellShape shape, const int* nodes, const Positions& x, const Point& point, double least) {
  Point at[9] = {};
  for (int a = 0; a < num_nodes(shape); ++a) at[a] = x[nodes[a]];
  if (dimension(shape) == 1) return closest_on_line({order(shape) + 1, {at[0], at[1], at[2]}}, point, least);
  const Face face{shape, at};
  ClosestOnSide best;
  if (face.closest_inside(point, best)) return best;
  best = {};
  for (int edge = 0; edge < num_edges(shape); ++edge) face.approach_edge(edge, point, least, best);
  return best;
}

}  // namespace mudline
