#pragma once

#include <utility>
#include <vector>

#include "ale/point_locator.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// For each vertex of a block, the elements to whose points a polynomial is fitted: those that touch the vertex, and
/// more around them where they have too few points. The patches depend on the topology alone. A rank has those of the
/// vertices that it needs: the corners of its own elements and of those around its own nodes.
class RecoveryPatches {
 public:
  struct Patch {
    int node;
    std::vector<int> elements;
  };
  RecoveryPatches(const GhostedMesh& mesh, const SoilBlock& block);
  const std::vector<Patch>& patches() const { return patches_; }
  /// Number of the patch around a vertex of the block; -1: it has none.
  int at(int node) const { return of_node_[node]; }
  /// Whether a patch wants elements that this rank does not have.
  bool cut() const { return cut_; }

 private:
  std::vector<Patch> patches_;
  std::vector<int> of_node_;  // -1: no vertex of the block
  bool cut_ = false;
};

/// A continuous field recovered from values at the quadrature points of one block: around every vertex a quadratic
/// polynomial is fitted, by least squares, to the points of the elements that touch it (Zienkiewicz & Zhu 1992), so
/// that slopes are of second order; mid-side nodes take the mean of the polynomials of the corners around them. At a
/// vertex on the block's boundary all points lie on one side, and a quadratic polynomial would make a steep field
/// steeper with every mesh motion: where it differs from the linear fit by more than a small share of the values'
/// range, it is blended into that fit. The axis of symmetry is no such boundary, because fields are even across it.
/// Linear fields are reproduced exactly, also on curved elements. Every rank fits the polynomials that its own nodes
/// need.
class Recovery {
 public:
  /// `x`: node positions for which `table` holds; `table`: (row of gather_points, column). Collective.
  Recovery(const GhostedMesh& mesh, const SoilBlock& block, const RecoveryPatches& patches, const Positions& x,
           const std::vector<double>& table, int columns);
  /// Values of all columns at a place of the block's mesh.
  void at(const MeshPlace& place, double* values) const;
  /// Values of all columns at a quadrature point of an element.
  void at_point(int element, int point, double* values) const;
  /// Range of the recovered field over an element's nodes, by column: highest less lowest value.
  void changes(int element, double* values) const;
  /// Lowest and highest of the old values at the element's points and the recovered values at its nodes. At a node
  /// inside the block the recovered value counts within the range of the old values around it, because the polynomial
  /// of a steep field overshoots. (On the block's boundary it is outside of that range even for a linear field.)
  const std::pair<double, double>& range(int element, int column) const {
    return range_[static_cast<std::size_t>(mesh_.first_row(element, 1)) * columns_ + column];
  }
  /// Position of a quadrature point.
  static Point position(const GhostedMesh::Element& element, const SoilBlock& block, int point, const Positions& x);

 private:
  /// Fills nodal_.
  template <int Dim>
  void fit(const RecoveryPatches& patches, const Positions& x);
  /// Range of the values at the points of some elements, by column: highest less lowest value.
  std::vector<double> ranges(const std::vector<int>& elements) const;
  /// Fills range_ from nodal_.
  void find_ranges();
  std::vector<double> bounded_nodes() const;
  const double* row(int element, int point) const {
    return &table_[static_cast<std::size_t>(mesh_.first_row(element, block_.points) + point) * columns_];
  }
  void interpolate(const GhostedMesh::Element& element, const double* N, int nodes, double* values) const;

  const GhostedMesh& mesh_;
  const SoilBlock& block_;
  const std::vector<double>& table_;
  int columns_;
  std::vector<double> nodal_;                     // (node, column)
  std::vector<std::pair<double, double>> range_;  // (element of the block, column)
};

/// The points of a block of a mesh whose nodes are at x.
struct BlockPoints {
  const GhostedMesh& mesh;
  const SoilBlock& block;
  const Positions& x;
  bool turned = false;  // the mesh is one of space, and its places are looked for in an axisymmetric section

  /// The place of an element's point, in the section where they are looked for there.
  Point place(int element, int point) const;
};

}  // namespace mudline
