#pragma once

#include <vector>

#include "ale/point_locator.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// A continuous field recovered from values at the quadrature points of one block: around every vertex a quadratic
/// polynomial is fitted, by least squares, to the points of the elements that touch it (Zienkiewicz & Zhu 1992), so
/// that slopes are of second order; middle nodes take the mean of what their two ends' polynomials say there. Linear
/// fields are reproduced exactly, also on curved elements.
class Recovery {
 public:
  /// `x`: where the points and nodes were; `table`: (row of gather_points, column).
  Recovery(const WholeMesh& mesh, const SoilBlock& block, const Positions& x, const std::vector<double>& table,
           int columns);
  /// Value at a place of the block's mesh.
  double at(const MeshPlace& place, int column) const;
  /// At a quadrature point of an element.
  double at_point(int element, int point, int column) const;
  /// Widens [low, high] by the old values of the element's points and by what is recovered at its nodes; at a node
  /// inside the block no farther than the old values around it reach, where the polynomial of a steep field overshoots.
  /// (On the block's boundary what is recovered lies outside of those values even for a linear field.)
  void widen_range(int element, int column, double& low, double& high) const;
  /// Position of a quadrature point.
  static std::array<double, 2> position(const WholeMesh::Element& element, const SoilBlock& block, int point,
                                        const Positions& x);

 private:
  const WholeMesh& mesh_;
  const SoilBlock& block_;
  const std::vector<double>& table_;
  int columns_;
  /// Fills bounded_ from nodal_.
  void bound_inner_nodes();

  std::vector<double> nodal_;    // (node, column)
  std::vector<double> bounded_;  // the same, within the old values around a node inside the block
};

}  // namespace mudline
