#pragma once

#include <array>
#include <vector>

#include "contact/plane_vector.hpp"
#include "discretisation/shapes.hpp"
#include "discretisation/side_map.hpp"
#include "framework/coordinates.hpp"
#include "framework/state.hpp"

namespace mudline {

/// Where contact is checked on a side.
enum class ContactPoints { quadrature, nodes };

constexpr int max_side_nodes = 3;
constexpr int max_contact_points = 6;  // Gauss points of degree 11

/// Coordinates of the nodes of one side [m]: two corners, then the middle of a quadratic side.
using SideCoordinates = std::array<PlanePoint, max_side_nodes>;
template <class Side>
SideCoordinates side_coordinates(const Side& side, const ConstCoordinateView& x) {
  SideCoordinates result{};
  for (int a = 0; a < side.count; ++a) result[a] = {x(side.node[a], 0), x(side.node[a], 1)};
  return result;
}
/// Largest distance of a node from the origin [m].
double farthest(const SideCoordinates& x);

/// Contact points on a side of 2 or 3 nodes and their areas. Point c lies at sum_a shape[c][a] X_a, spreads its force
/// to the nodes by the same shape, and has the area A_c = sum_q weight[c][q] |x'(q)| measure(x(q)) over Gauss points q.
/// Surface quadrature: the points are the Gauss points. Nodes: shape is the identity and A_c = int N_c ds, the
/// tributary area.
struct ContactRule {
  ContactRule(ContactPoints kind, int nodes, int degree);
  /// Where point c lies on a side with these nodes [m].
  PlanePoint place(int c, const SideCoordinates& x) const;
  int nodes, points, samples;
  std::vector<std::array<double, max_side_nodes>> shape;  // (point, node)
  std::vector<double> xi;                                 // (point) reference coordinate in [-1, 1]
  std::vector<std::vector<double>> weight;                // (point, sample)
  std::vector<std::array<double, max_side_nodes>> N, dN;  // (sample, node)
};

/// Current areas of the contact points of a side [m2], in plane strain per metre of depth, from the nodes' positions
/// x[a][i]. False when the side is degenerate: no length, or r < 0.
template <class T, class Nodes>
bool contact_areas(const ContactRule& rule, const Nodes& x, Geometry geometry, T (&area)[max_contact_points]) {
  for (int c = 0; c < rule.points; ++c) area[c] = T(0.0);
  for (int q = 0; q < rule.samples; ++q) {
    SideMap<2, T> map;
    map.compute(rule.nodes, rule.N[q].data(), rule.dN[q].data(), [&](int a, int i) { return x[a][i]; });
    const T around = measure(geometry, map.x);
    if (!(value(map.stretch) > 0) || !(value(around) >= 0)) return false;
    const T whole = map.stretch * around;
    for (int c = 0; c < rule.points; ++c)
      if (rule.weight[c][q] != 0) area[c] += rule.weight[c][q] * whole;
  }
  return true;
}

}  // namespace mudline
