#pragma once

#include "algebra/assembler.hpp"
#include "discretisation/shapes.hpp"
#include "framework/state.hpp"

namespace mudline {

constexpr int max_scalars = 2;  // most scalar fields of one block; element loops are compiled for each number

/// The elements of one mesh block with the tables that their fields need. Columns of `dofs`: displacement node by node,
/// then the scalar fields one after the other, each at all nodes or at the cell's corners.
struct FieldBlock {
  CellShape shape, scalar_shape;
  int elements = 0, points = 0;
  int degree = 0;  // degree of the quadrature
  // Terms of the polynomial fitted to the volume strain that stresses see, against volumetric locking: 1 or one more
  // than directions; 0: the volume strain of each point.
  int dilatation_terms = 0;
  int displacement = -1;  // index of the displacement field; -1: not among the unknowns
  int scalars = 0;        // number of scalar fields
  int scalar[max_scalars] = {};
  ShapeTable u, p;  // shapes of cell and scalar fields at the same quadrature points; p.nodes == 0 without scalars
  Kokkos::View<int**, Kokkos::LayoutRight> nodes;
  ElementDofs dofs;
  RowLists rows;   // row lists of `dofs`
  int group = -1;  // element group of the assembler

  bool moves() const { return displacement >= 0; }
  /// The same elements with tables for a quadrature of another degree.
  FieldBlock with_quadrature(int degree) const;
  /// Position [m] of quadrature point q of element e in the configuration x.
  Point place(int e, int q, const ConstCoordinateView& x) const;
  /// Value of scalar field k (index into `scalar`) at quadrature point q; `values` by overlap dof.
  double scalar_at(int e, int q, int k, const ConstNodalView& values) const;

  // Not inline, as those of LoopLevel.
  FieldBlock();
  FieldBlock(const FieldBlock&);
  FieldBlock& operator=(const FieldBlock&);
  ~FieldBlock();
  /// displacement: index of that field, or -1; scalar_fields: indices of fields that have the same nodes; degree:
  /// degree of the quadrature. std::logic_error where the scalar fields do not fit.
  FieldBlock(const Space& space, int block, int displacement, const std::vector<int>& scalar_fields, int degree);
};

}  // namespace mudline
