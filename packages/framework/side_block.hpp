#pragma once

#include <vector>

#include "algebra/assembler.hpp"
#include "core/function.hpp"
#include "discretisation/shapes.hpp"
#include "framework/state.hpp"

namespace mudline {

/// Sides of the boundary with the same number of nodes, and the tables that a load on one field needs. Columns of
/// `dofs`: the displacement node by node, or a scalar field at its nodes, which are the first nodes of the side.
struct SideBlock {
  int sides = 0, points = 0;
  ShapeTable shape, partner;  // shapes of the side and of the field at the same quadrature points
  Kokkos::View<int**, Kokkos::LayoutRight> nodes;
  ElementDofs dofs;
  RowLists rows;  // row lists of `dofs`
  int field = -1;
  int group = -1;  // element group of the assembler

  SideBlock() = default;
  /// Sides of one shape. of_sides: nodes of each side in the order of that shape; degree: degree of the quadrature.
  SideBlock(const Space& space, int field, CellShape side, const std::vector<std::vector<int>>& of_sides, int degree);
  /// Position [m] of quadrature point q of side s in the configuration x.
  Point place(int s, int q, const ConstCoordinateView& x) const;
};

}  // namespace mudline
