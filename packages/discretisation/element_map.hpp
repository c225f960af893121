#pragma once

#include <array>

#include "discretisation/cell_map.hpp"
#include "discretisation/shapes.hpp"

namespace mudline {

/// The isoparametric map of one element: its shape and the places of its nodes.
class ElementMap {
 public:
  /// `place(a)`: coordinates of local node a [m], anything that [0] and [1] can be taken of.
  template <class Place>
  ElementMap(CellShape shape, Place&& place) : shape_(shape), nodes_(num_nodes(shape)) {
    for (int a = 0; a < nodes_; ++a)
      for (int i = 0; i < 2; ++i) x_[a][i] = place(a)[i];
  }
  CellShape shape() const { return shape_; }
  const double* node(int a) const { return x_[a]; }
  std::array<double, 2> at(const double xi[2]) const;
  /// Determinant of the map's gradient [m2].
  double determinant(const double xi[2]) const;
  /// Reference coordinates of a point, by Newton's method. False where it finds none.
  bool invert(const std::array<double, 2>& point, double xi[2]) const;
  /// Scaled Jacobian [-]: the smallest, over the nodes, of the determinant divided by the product of the lengths of the
  /// two edges that span it at the nearest corner, so that it is 1 for the equilateral triangle and for the square, 0
  /// for a degenerate and negative for a folded element (Knupp 2003). Curved sides count: corners, middle nodes and the
  /// centre are looked at. Minus infinity where a place is not a number.
  double scaled_jacobian() const;

 private:
  /// The map at a place, and where the place is.
  CellMap<2> map(const double xi[2], std::array<double, 2>& x) const;

  CellShape shape_;
  int nodes_;
  double x_[9][2];
};

/// How far reference coordinates lie beyond a side, in reference units; negative inside.
double beyond_side(CellShape shape, int side, const double xi[2]);
/// How far they lie outside the cell; negative inside.
double outside_cell(CellShape shape, const double xi[2]);
/// Reference coordinates of the place t in [-1, 1] on a side.
std::array<double, 2> on_side(CellShape shape, int side, double t);

}  // namespace mudline
