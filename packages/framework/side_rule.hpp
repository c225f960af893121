#pragma once

#include <Kokkos_Core.hpp>

#include <algorithm>
#include <array>
#include <vector>

#include "discretisation/shapes.hpp"
#include "discretisation/side_map.hpp"
#include "framework/coordinates.hpp"
#include "framework/state.hpp"
#include "tensor/vec.hpp"

namespace mudline {

constexpr int max_line_nodes = 3;  // of a side in the plane
constexpr int max_side_nodes = 9;  // of a side in space too

/// Coordinates of the nodes of one side [m], in the order of its shape; in the plane the third ones are 0.
using SideCoordinates = std::array<Point, max_side_nodes>;
/// Those of the local nodes node[0], node[1], ...
inline SideCoordinates side_coordinates(const int* node, int count, const ConstCoordinateView& x) {
  SideCoordinates result{};
  for (int a = 0; a < count; ++a) result[a] = place_of(x, node[a]);
  return result;
}

/// Points of a side and the parts of it that they stand for. Point c lies at sum_a shape(c, a) X_a, and has the area
/// A_c = sum_q weight(c, q) |x'(q)| measure(x(q)) over Gauss points q, with |x'| the area per reference area. Gauss:
/// these points themselves. Nodes, corners: A_c = int N_c ds with the shapes of all nodes or the linear ones of the
/// corners, the tributary area. Centre: one point for all of the side, at the mean of its corners.
struct SideRule {
  enum class At { gauss, nodes, corners, centre };
  /// `degree`: of the quadrature.
  SideRule(CellShape side, At at, int degree);
  /// Where point c lies on a side with these nodes [m].
  Point place(int c, const SideCoordinates& x) const {
    Point at{};
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < 3; ++i) at[i] += shape(c, a) * x[a][i];
    return at;
  }

  using Table = Kokkos::View<double**, Kokkos::LayoutRight>;
  CellShape side;
  int nodes, points, samples;
  Table shape;                     // (point, node)
  Table weight;                    // (point, sample)
  Table N, dN;                     // (sample, node), (sample, node and reference coordinate)
  std::vector<Vec<double, 3>> xi;  // (point) reference coordinates
};

/// Current areas of the points of a side [m2], in plane strain per metre of depth, from the nodes' positions x[a][i].
/// D: dimension. False when the side is degenerate: no area, or r < 0.
template <int D, class T, class Nodes>
bool point_areas(const SideRule& rule, const Nodes& x, Geometry geometry, T* area) {
  for (int c = 0; c < rule.points; ++c) area[c] = T(0.0);
  for (int q = 0; q < rule.samples; ++q) {
    SideMap<D, T> map;
    map.compute(rule.nodes, &rule.N(q, 0), &rule.dN(q, 0), [&](int a, int i) { return T(x[a][i]); });
    const T around = measure(geometry, map.x.data());
    if (!(value(map.stretch) > 0) || !(value(around) >= 0)) return false;
    const T whole = map.stretch * around;
    for (int c = 0; c < rule.points; ++c)
      if (rule.weight(c, q) != 0) area[c] += rule.weight(c, q) * whole;
  }
  return true;
}
/// Overload that takes the dimension from the side's shape.
bool point_areas(const SideRule& rule, const SideCoordinates& x, Geometry geometry, double* area);

}  // namespace mudline
