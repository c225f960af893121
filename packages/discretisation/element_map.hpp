#pragma once

#include "discretisation/cell_map.hpp"
#include "discretisation/shapes.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// Of the cell with straight edges through the corners [m].
struct ElementSize {
  double shortest_edge, longest_edge;
  double height;  // area over the longest edge; in space volume over the largest face
};

/// The isoparametric map of one cell of the plane or of space: its shape and the places of its nodes.
class ElementMap {
 public:
  /// `place(a)`: coordinates of local node a [m], anything of which [0], [1] and in space [2] can be taken.
  template <class NodePlace>
  ElementMap(CellShape shape, NodePlace&& place)
      : shape_(shape), nodes_(num_nodes(shape)), dimension_(mudline::dimension(shape)) {
    for (int a = 0; a < nodes_; ++a)
      for (int i = 0; i < dimension_; ++i) x_[a][i] = place(a)[i];
  }
  CellShape shape() const { return shape_; }
  /// (dimension) [m]
  const double* node(int a) const { return x_[a]; }
  /// [m]; in the plane its third coordinate is 0.
  Vec<double, 3> mean_of_corners() const;
  ElementSize size() const;
  /// The place that reference coordinates stand for; in the plane its third coordinate is 0.
  Vec<double, 3> at(const double* xi) const;
  /// Determinant of the map's gradient [m^dimension].
  double determinant(const double* xi) const;
  /// Reference coordinates (dimension) of a point (dimension), by Newton's method. False where it finds none.
  bool invert(const double* point, double* xi) const;
  /// Scaled Jacobian [-]: the smallest, over the nodes, of the determinant divided by the product of the lengths of the
  /// edges that span it at the nearest corner (two in the plane, three in space), so that it is 1 for the equilateral
  /// triangle, the square, the regular tetrahedron and the cube, 0 for a degenerate and negative for a folded element
  /// (Knupp 2003). Curved sides count: corners, the other nodes and the centre are looked at. Minus infinity where a
  /// place is not a number.
  double scaled_jacobian() const;

 private:
  /// The map at a place, and where the place is.
  template <int Dim>
  CellMap<Dim> map(const double* xi, Vec<double, 3>& x) const;
  template <int Dim>
  bool invert_in(const double* point, double* xi) const;

  CellShape shape_;
  int nodes_, dimension_;
  double x_[27][3];
};

/// How far reference coordinates lie beyond a side, in reference units; negative inside.
double beyond_side(CellShape shape, int side, const double* xi);
/// How far they lie outside the cell; negative inside.
double outside_cell(CellShape shape, const double* xi);
/// Reference coordinates of a cell's centre; those that it has not are 0.
Vec<double, 3> cell_centre(CellShape shape);
/// Reference coordinates in the cell of a place on one of its sides, which is given by those of the side's own shape.
Vec<double, 3> on_side(CellShape shape, int side, const Vec<double, 2>& place);
/// The same in the plane: the place t in [-1, 1].
inline Vec<double, 3> on_side(CellShape shape, int side, double t) {
  return on_side(shape, side, Vec<double, 2>{t, 0});
}

}  // namespace mudline
