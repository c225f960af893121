#pragma once

#include <utility>
#include <vector>

#include "ale/point_locator.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// The elements to whose points a polynomial around each vertex of a block is fitted: those that touch it, and more
/// around them where they have too few points. They depend on the topology alone. Of the vertices that this rank needs:
/// the corners of its own elements and of those around its own nodes.
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
/// that slopes are of second order; middle nodes take the mean of what the polynomials of the corners around say there.
/// At a vertex on the block's boundary all points lie on one side, and a quadratic polynomial would make a field that
/// is steep there steeper from motion to motion: where it differs from the linear one by more than a small share of the
/// values' range it gives way to that one. Fields are even across the axis of symmetry, which is no such boundary.
/// Linear fields are reproduced exactly, also on curved elements. Every rank fits what its own nodes need.
class Recovery {
 public:
  /// `x`: where the points and nodes were; `table`: (row of gather_points, column). Collective.
  Recovery(const GhostedMesh& mesh, const SoilBlock& block, const RecoveryPatches& patches, const Positions& x,
           const std::vector<double>& table, int columns);
  /// Values of all columns at a place of the block's mesh.
  void at(const MeshPlace& place, double* values) const;
  /// At a quadrature point of an element.
  void at_point(int element, int point, double* values) const;
  /// (column) by how much what is recovered at an element's nodes differs, the highest less the lowest value.
  void changes(int element, double* values) const;
  /// Lowest and highest of the old values of the element's points and of what is recovered at its nodes; at a node
  /// inside the block no farther than the old values around it reach, where the polynomial of a steep field overshoots.
  /// (On the block's boundary what is recovered lies outside of those values even for a linear field.)
  const std::pair<double, double>& range(int element, int column) const {
    return range_[static_cast<std::size_t>(mesh_.first_row(element, 1)) * columns_ + column];
  }
  /// Position of a quadrature point.
  static Point position(const GhostedMesh::Element& element, const SoilBlock& block, int point, const Positions& x);

 private:
  /// Fills nodal_.
  template <int Dim>
  void fit(const RecoveryPatches& patches, const Positions& x);
  /// (column) highest less lowest value at the points of some elements.
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
};

}  // namespace mudline
