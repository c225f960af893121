#pragma once

#include <Kokkos_Core.hpp>
#include <Tpetra_FECrsMatrix.hpp>

#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "algebra/dof_map.hpp"

namespace mudline {

/// Local overlap dofs of every element of one group: (element, dof). One group per element block and field combination.
using ElementDofs = Kokkos::View<const int**, Kokkos::LayoutRight>;

/// Writes element matrices into the local values of the matrix. Copied into kernels. Rows and columns of one node's
/// components lie side by side in the matrix, so that one position serves them all: it is kept per element and pair of
/// nodes. Constrained dofs: off-diagonal entries of their rows and columns are dropped, the diagonal is kept (a
/// correctly scaled, symmetric, AMG-friendly identity row; the residual is zero there).
struct MatrixScatter {
  /// (element, row node, column node): within the row. Wide only where rows are longer than 65536, as those of a body.
  struct Positions {
    Kokkos::View<const std::uint16_t***, Kokkos::LayoutRight> narrow;
    Kokkos::View<const std::uint32_t***, Kokkos::LayoutRight> wide;
    KOKKOS_INLINE_FUNCTION std::uint32_t operator()(int e, int row, int column) const {
      return wide.data() == nullptr ? narrow(e, row, column) : wide(e, row, column);
    }
  };
  /// Of one column of a group's dofs: which of its nodes, and which of that node's columns.
  struct Place {
    int node, component;
  };

  Kokkos::View<double*> values;
  Kokkos::View<const std::size_t*> row_begin;  // by overlap dof
  Positions positions;
  Kokkos::View<const Place*> places;  // by column of `dofs`
  ElementDofs dofs;
  Kokkos::View<const char*> constrained;  // by overlap dof

  /// Adds the entry (a, b) of element e's matrix.
  KOKKOS_INLINE_FUNCTION void add(int e, int a, int b, double value) const {
    const int row = dofs(e, a);
    if (a != b && (constrained(row) || constrained(dofs(e, b)))) return;
    const std::size_t first = row_begin(row) + positions(e, places(a).node, places(b).node);
    accumulate(&values(first + places(b).component), value);
  }
  /// Adds weight times k, the rows from row0 and the columns from column0 on of element e's matrix.
  template <int R, int C>
  KOKKOS_INLINE_FUNCTION void add(int e, int row0, int column0, const double (&k)[R][C], double weight) const {
    bool fixed_column[C];
    std::uint32_t position[C] = {};  // within the rows of the node `at`
    for (int c = 0; c < C; ++c) fixed_column[c] = constrained(dofs(e, column0 + c));
    int at = -1;
    for (int r = 0; r < R; ++r) {
      const int row = dofs(e, row0 + r);
      if (const int node = places(row0 + r).node; node != at) {
        at = node;
        for (int c = 0; c < C; ++c) {
          const Place place = places(column0 + c);
          position[c] = positions(e, at, place.node) + place.component;
        }
      }
      const bool fixed_row = constrained(row);
      double* const entries = &values(row_begin(row));
      for (int c = 0; c < C; ++c) {
        if ((fixed_row || fixed_column[c]) && row0 + r != column0 + c) continue;
        accumulate(entries + position[c], weight * k[r][c]);
      }
    }
  }
#ifdef KOKKOS_ENABLE_SERIAL
  static constexpr bool concurrent = !std::is_same_v<Kokkos::DefaultExecutionSpace, Kokkos::Serial>;
#else
  static constexpr bool concurrent = true;
#endif
  /// Atomic only where the execution space is concurrent.
  KOKKOS_INLINE_FUNCTION static void accumulate(double* target, double value) {
    if constexpr (concurrent)
      Kokkos::atomic_add(target, value);
    else
      *target += value;
  }
};

/// The sparse Jacobian: graph from element groups, built once; assembled any number of times.
class Assembler {
 public:
  explicit Assembler(RCP<const DofMap> dofs);

  /// Registers a group (before finalise); returns its id.
  int add_group(ElementDofs dofs);
  /// Builds graph, matrix and positions. Collective.
  void finalise();

  /// Zeroes the matrix and opens it for scatter. `constrained` is by overlap dof and must agree across ranks.
  void begin(Kokkos::View<const char*> constrained);
  MatrixScatter scatter(int group) const;
  /// Exports shared rows; afterwards matrix() is complete. A zero diagonal of a constrained dof becomes 1. Collective.
  /// Every MatrixScatter must be out of scope.
  void end();

  RCP<const CrsMatrix> matrix() const { return matrix_; }
  const RCP<const DofMap>& dofs() const { return dofs_; }

 private:
  using FEMatrix = Tpetra::FECrsMatrix<>;
  /// Where the matrix has the entries of one group of elements.
  struct Entries {
    MatrixScatter::Positions positions;
    Kokkos::View<const MatrixScatter::Place*> places;
  };
  void find_entries();
  RCP<const DofMap> dofs_;
  std::vector<ElementDofs> groups_;
  std::vector<Entries> entries_;
  Kokkos::View<const std::size_t*> row_begin_;
  RCP<FEMatrix> matrix_;
  Kokkos::View<const char*> constrained_;
};

}  // namespace mudline
