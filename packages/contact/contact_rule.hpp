#pragma once

#include <array>
#include <vector>

#include "contact/vector.hpp"
#include "framework/side_rule.hpp"
#include "framework/state.hpp"
#include "tensor/vec.hpp"

namespace mudline {

constexpr int max_contact_points = 36;  // Gauss points of degree 11 on a quadrilateral

/// Coordinates of a side with the members `node` and `count`.
template <class Side>
SideCoordinates side_coordinates(const Side& side, const ConstCoordinateView& x) {
  return side_coordinates(&side.node[0], side.count, x);
}
/// Largest distance of a node from the origin [m].
double farthest(const SideCoordinates& x);

/// Contact points on a side, Gauss points or (in the plane) nodes: a point spreads its force to the nodes by the shape
/// that gives its place.
struct ContactRule : SideRule {
  ContactRule(At at, CellShape side, int degree);
  /// Shapes of multipliers at point c: those of the side. On a triangle of six and a quadrilateral of eight nodes the
  /// linear ones of the corners: the integrals of their own vanish or are negative there, and nothing can be averaged
  /// by them.
  const double* multiplier_shape(int c) const { return multipliers < nodes ? &corner(c, 0) : &shape(c, 0); }
  /// Unit normal at point c out of the slave.
  Point outward(int c, const SideCoordinates& x) const;

  int multipliers;                  // number of the first nodes that have multipliers
  Table corner;                     // (point, corner) of the linear shape on the corners
  Table shape_slope, corner_slope;  // reference gradients (point, corner or node and reference coordinate)
};

/// Slopes of areas [m] by the positions of the side's nodes (node, axis).
using AreaSlopes = double[max_contact_points][3 * max_side_nodes];
/// Areas of the points with their slopes.
bool point_areas(const SideRule& rule, const SideCoordinates& x, Geometry geometry, double* area, AreaSlopes& slope);

/// Weight of a node at a contact point: 1 at the node, falling to 0 at half the side's length. It is never negative,
/// unlike the quadratic shapes.
double nearness(const ContactRule& rule, int point, int node);

}  // namespace mudline
