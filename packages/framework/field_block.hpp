#pragma once

#include "algebra/assembler.hpp"
#include "discretisation/shapes.hpp"
#include "framework/state.hpp"

namespace mudline {

constexpr int max_scalars = 2;  // in one block; element loops are compiled for each number

/// The elements of one mesh block with the tables that their fields need. Columns of `dofs`: displacement node by node,
/// then the scalar fields one after the other, each at all nodes or at the cell's corners.
struct FieldBlock {
  CellShape shape, scalar_shape;
  int elements = 0, points = 0;
  int displacement = -1;  // its field; -1: not among them
  int scalars = 0;        // number of scalar fields
  int scalar[max_scalars] = {};
  ShapeTable u, p;  // of the cell and of the scalar fields, at the same quadrature points; p.nodes == 0 without these
  Kokkos::View<int**, Kokkos::LayoutRight> nodes;
  ElementDofs dofs;
  RowLists rows;   // of `dofs`
  int group = -1;  // of the assembler

  bool moves() const { return displacement >= 0; }
  /// The same elements with tables for a quadrature of another degree.
  FieldBlock with_quadrature(int degree) const;
  /// Where quadrature point q of element e lies on a configuration [m].
  Point place(int e, int q, const ConstCoordinateView& x) const;
  /// The scalar field at place k of `scalar` at a quadrature point; `values` by overlap dof.
  double scalar_at(int e, int q, int k, const ConstNodalView& values) const;

  FieldBlock() = default;
  /// displacement: its field, or -1; scalar_fields: all with the same nodes. degree: of the quadrature.
  FieldBlock(const Space& space, int block, int displacement, const std::vector<int>& scalar_fields, int degree);
};

}  // namespace mudline
