#pragma once

#include <array>
#include <vector>

#include "contact/vector.hpp"
#include "discretisation/shapes.hpp"
#include "discretisation/side_map.hpp"
#include "framework/coordinates.hpp"
#include "framework/state.hpp"

namespace mudline {

/// Where contact is checked on a side.
enum class ContactPoints { quadrature, nodes };

constexpr int max_line_nodes = 3;       // of a side in the plane
constexpr int max_side_nodes = 9;       // of a side in space too
constexpr int max_contact_points = 36;  // Gauss points of degree 11 on a quadrilateral

/// Coordinates of the nodes of one side [m], in the order of its shape; in the plane the third ones are 0.
using SideCoordinates = std::array<Point, max_side_nodes>;
template <class Side>
SideCoordinates side_coordinates(const Side& side, const ConstCoordinateView& x) {
  SideCoordinates result{};
  for (int a = 0; a < side.count; ++a) result[a] = place_of(x, side.node[a]);
  return result;
}
/// Largest distance of a node from the origin [m].
double farthest(const SideCoordinates& x);

/// Contact points on a side and their areas. Point c lies at sum_a shape[c][a] X_a, spreads its force to the nodes by
/// the same shape, and has the area A_c = sum_q weight[c][q] |x'(q)| measure(x(q)) over Gauss points q, with |x'| the
/// area per reference area. Surface quadrature: the points are the Gauss points. Nodes (in the plane): shape is the
/// identity and A_c = int N_c ds, the tributary area.
struct ContactRule {
  ContactRule(ContactPoints kind, CellShape side, int degree);
  /// Where point c lies on a side with these nodes [m].
  Point place(int c, const SideCoordinates& x) const;
  CellShape side;
  int nodes, points, samples;
  std::vector<std::array<double, max_side_nodes>> shape;   // (point, node)
  std::vector<std::array<double, max_side_nodes>> corner;  // (point, corner) of the linear shape on the corners
  // their reference gradients (point, corner or node, reference coordinate)
  std::vector<std::array<double, 2 * max_side_nodes>> shape_slope, corner_slope;
  std::vector<std::array<double, 3>> xi;                   // (point) reference coordinates
  std::vector<std::vector<double>> weight;                 // (point, sample)
  std::vector<std::array<double, max_side_nodes>> N;       // (sample, node)
  std::vector<std::array<double, 2 * max_side_nodes>> dN;  // (sample, node, reference coordinate)
};

/// Current areas of the contact points of a side [m2], in plane strain per metre of depth, from the nodes' positions
/// x[a][i]. D: dimension. False when the side is degenerate: no area, or r < 0.
template <int D, class T, class Nodes>
bool contact_areas(const ContactRule& rule, const Nodes& x, Geometry geometry, T* area) {
  for (int c = 0; c < rule.points; ++c) area[c] = T(0.0);
  for (int q = 0; q < rule.samples; ++q) {
    SideMap<D, T> map;
    map.compute(rule.nodes, rule.N[q].data(), rule.dN[q].data(), [&](int a, int i) { return T(x[a][i]); });
    const T around = measure(geometry, map.x);
    if (!(value(map.stretch) > 0) || !(value(around) >= 0)) return false;
    const T whole = map.stretch * around;
    for (int c = 0; c < rule.points; ++c)
      if (rule.weight[c][q] != 0) area[c] += rule.weight[c][q] * whole;
  }
  return true;
}
/// The same by the side's dimension.
bool contact_areas(const ContactRule& rule, const SideCoordinates& x, Geometry geometry, double* area);

/// 1 at a node of a side, falling to 0 at half the side's length: positive weights, unlike the quadratic shapes.
double nearness(const ContactRule& rule, int point, int node);

}  // namespace mudline
