#pragma once

#include <array>
#include <vector>

#include "contact/vector.hpp"
#include "discretisation/shapes.hpp"
#include "discretisation/side_map.hpp"
#include "framework/coordinates.hpp"
#include "framework/state.hpp"
#include "tensor/vec.hpp"

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
  Point place(int c, const SideCoordinates& x) const {
    Point at{};
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < 3; ++i) at[i] += shape(c, a) * x[a][i];
    return at;
  }
  /// Shapes of multipliers at point c: those of the side. On a triangle of six and a quadrilateral of eight nodes the
  /// linear ones of the corners: the integrals of their own vanish or are negative there, and nothing can be averaged
  /// by them.
  const double* multiplier_shape(int c) const { return multipliers < nodes ? &corner(c, 0) : &shape(c, 0); }
  /// Unit normal at point c out of the slave.
  Point outward(int c, const SideCoordinates& x) const;

  using Table = Kokkos::View<double**, Kokkos::LayoutRight>;
  CellShape side;
  int nodes, points, samples;
  int multipliers;                  // number of the first nodes that have multipliers
  Table shape;                      // (point, node)
  Table corner;                     // (point, corner) of the linear shape on the corners
  Table shape_slope, corner_slope;  // their reference gradients (point, corner or node and reference coordinate)
  Table weight;                     // (point, sample)
  Table N, dN;                      // (sample, node), (sample, node and reference coordinate)
  std::vector<Vec<double, 3>> xi;   // (point) reference coordinates
};

/// Current areas of the contact points of a side [m2], in plane strain per metre of depth, from the nodes' positions
/// x[a][i]. D: dimension. False when the side is degenerate: no area, or r < 0.
template <int D, class T, class Nodes>
bool contact_areas(const ContactRule& rule, const Nodes& x, Geometry geometry, T* area) {
  for (int c = 0; c < rule.points; ++c) area[c] = T(0.0);
  for (int q = 0; q < rule.samples; ++q) {
    SideMap<D, T> map;
    map.compute(rule.nodes, &rule.N(q, 0), &rule.dN(q, 0), [&](int a, int i) { return T(x[a][i]); });
    const T around = measure(geometry, map.x);
    if (!(value(map.stretch) > 0) || !(value(around) >= 0)) return false;
    const T whole = map.stretch * around;
    for (int c = 0; c < rule.points; ++c)
      if (rule.weight(c, q) != 0) area[c] += rule.weight(c, q) * whole;
  }
  return true;
}
/// Overload that takes the dimension from the side's shape.
bool contact_areas(const ContactRule& rule, const SideCoordinates& x, Geometry geometry, double* area);
/// Slopes of areas [m] by the positions of the side's nodes (node, axis).
using AreaSlopes = double[max_contact_points][3 * max_side_nodes];
/// Overload that gives the slopes too.
bool contact_areas(const ContactRule& rule, const SideCoordinates& x, Geometry geometry, double* area,
                   AreaSlopes& slope);

/// Weight of a node at a contact point: 1 at the node, falling to 0 at half the side's length. It is never negative,
/// unlike the quadratic shapes.
double nearness(const ContactRule& rule, int point, int node);

}  // namespace mudline
