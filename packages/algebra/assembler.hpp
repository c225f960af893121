#pragma once

#include <Kokkos_Core.hpp>
#include <Tpetra_FECrsMatrix.hpp>

#include <cstdint>
#include <memory>
#include <vector>

#include "algebra/dof_map.hpp"
#include "algebra/row_lists.hpp"

namespace mudline {

/// Writes element matrices into the local values of the matrix. Copied into kernels. Rows and columns of one node's
/// components lie side by side in the matrix, so that one position, stored per element and pair of nodes, serves them
/// all. Constrained dofs: off-diagonal entries of their rows and columns are dropped, the diagonal is kept (a correctly
/// scaled, symmetric, AMG-friendly identity row; the residual is zero there).
struct MatrixScatter {
  /// (element, row node, column node) -> offset within the row. Wide only where rows are longer than 65536, as those of
  /// a body.
  struct Positions {
    Kokkos::View<const std::uint16_t***, Kokkos::LayoutRight> narrow;
    Kokkos::View<const std::uint32_t***, Kokkos::LayoutRight> wide;
    KOKKOS_INLINE_FUNCTION std::uint32_t operator()(int e, int row, int column) const {
      return wide.data() == nullptr ? narrow(e, row, column) : wide(e, row, column);
    }
  };
  /// The node of the group, and the component of that node, that a column of a group's dofs belongs to.
  struct Place {
    int node, component;
  };

  /// The filled columns of a row of the buffer.
  struct Span {
    int first, count;
  };

  static constexpr int most_columns = 128;  // of a matrix that is added

  Kokkos::View<double*> values;
  Kokkos::View<const std::size_t*> row_begin;  // by overlap dof
  Positions positions;
  Kokkos::View<const Place*> places;  // by column of `dofs`
  ElementDofs dofs;
  Kokkos::View<const char*> constrained;                 // by overlap dof
  Kokkos::View<const char*> left_out;                    // by overlap dof: rows that get nothing; empty: none
  ElementBuffer buffer = {};                             // for loops on several threads
  Kokkos::View<Span**, Kokkos::LayoutRight> spans = {};  // (element of the batch, row)

  /// Adds the entry (a, b) of element e's matrix. From one thread only.
  KOKKOS_INLINE_FUNCTION void add(int e, int a, int b, double value) const {
    const int row = dofs(e, a);
    if (leaves_out(row)) return;
    if (a != b && (constrained(row) || constrained(dofs(e, b)))) return;
    const std::size_t first = row_begin(row) + positions(e, places(a).node, places(b).node);
    values(first + places(b).component) += value;
  }
  /// Adds weight times k, the rows from row0 and the columns from column0 on of element e's matrix. From one thread, or
  /// within in_order().
  template <int R, int C>
  KOKKOS_INLINE_FUNCTION void add(int e, int row0, int column0, const double (&k)[R][C], double weight) const {
    static_assert(C <= most_columns);
    add(e, row0, R, column0, C, &k[0][0], weight);
  }

  /// Adds the rows and columns 0 to n - 1, row after row, of element e's matrix.
  KOKKOS_INLINE_FUNCTION void add(int e, int n, const double* k) const {
    for (int a = 0; a < n; ++a) {
      if (buffer.used()) spans(e - buffer.first, a) = {0, n};
      for (int b = 0; b < n; ++b)
        if (buffer.used())
          buffer.values(e - buffer.first, a, b) = k[n * a + b];
        else
          add(e, a, b, k[n * a + b]);
    }
  }

  // The functions open_buffer, open and take serve in_order().
  void open_buffer(int elements);
  /// Clears element e's rows of the buffer; call it before the element adds.
  KOKKOS_INLINE_FUNCTION void open(int e) const {
    if (!buffer.used()) return;
    for (int a = 0; a < static_cast<int>(spans.extent(1)); ++a) spans(e - buffer.first, a).count = 0;
  }
  KOKKOS_INLINE_FUNCTION void take(int row, int entry) const {
    const int i = entry / static_cast<int>(dofs.extent(1)), a = entry % static_cast<int>(dofs.extent(1));
    const int e = buffer.first + i;
    const Span span = spans(i, a);
    if (leaves_out(row)) return;
    const bool fixed_row = constrained(row);
    double* const entries = &values(row_begin(row));
    for (int b = span.first; b < span.first + span.count; ++b) {
      if ((fixed_row || constrained(dofs(e, b))) && a != b) continue;
      entries[positions(e, places(a).node, places(b).node) + places(b).component] += buffer.values(i, a, b);
    }
  }

 private:
  KOKKOS_INLINE_FUNCTION bool leaves_out(int row) const { return left_out.extent(0) > 0 && left_out(row); }
  /// Adds k of any size: (row, column), row after row. It is called, not inlined, because many loops use it.
  [[gnu::noinline]] KOKKOS_FUNCTION void add(int e, int row0, int rows, int column0, int columns, const double* k,
                                             double weight) const {
    if (buffer.used()) return keep(e - buffer.first, row0, rows, column0, columns, k, weight);
    bool fixed_column[most_columns];
    std::uint32_t position[most_columns];  // within the rows of the node `at`
    for (int c = 0; c < columns; ++c) fixed_column[c] = constrained(dofs(e, column0 + c));
    int at = -1;
    for (int r = 0; r < rows; ++r) {
      const int row = dofs(e, row0 + r);
      if (const int node = places(row0 + r).node; node != at) {
        at = node;
        for (int c = 0; c < columns; ++c) {
          const Place place = places(column0 + c);
          position[c] = positions(e, at, place.node) + place.component;
        }
      }
      if (leaves_out(row)) continue;
      const bool fixed_row = constrained(row);
      double* const entries = &values(row_begin(row));
      for (int c = 0; c < columns; ++c) {
        if ((fixed_row || fixed_column[c]) && row0 + r != column0 + c) continue;
        entries[position[c]] += weight * k[columns * r + c];
      }
    }
  }

  KOKKOS_FUNCTION void keep(int i, int row0, int rows, int column0, int columns, const double* k, double weight) const {
    for (int r = 0; r < rows; ++r) {
      spans(i, row0 + r) = {column0, columns};
      double* const to = &buffer.values(i, row0 + r, column0);
      for (int c = 0; c < columns; ++c) to[c] = weight * k[columns * r + c];
    }
  }
};

/// The sparse Jacobian: its graph is built once from element groups, its values are assembled any number of times.
class Assembler {
 public:
  explicit Assembler(RCP<const DofMap> dofs);

  /// Registers a group (before finalise); returns its id.
  int add_group(ElementDofs dofs);
  /// Builds graph, matrix and positions. Collective.
  void finalise();

  /// Zeroes the matrix and opens it for scatter. `constrained` is by overlap dof and must agree across ranks.
  void begin(Kokkos::View<const char*> constrained);
  /// From now on, until begin(), nothing is added to these rows, by overlap dof.
  void leave_out(Kokkos::View<const char*> rows) { left_out_ = rows; }
  MatrixScatter scatter(int group) const;
  /// Exports shared rows; afterwards matrix() is complete. A zero diagonal of a constrained dof becomes 1. Collective.
  /// Every MatrixScatter must be out of scope.
  void end();

  RCP<const CrsMatrix> matrix() const { return matrix_; }
  const RCP<const DofMap>& dofs() const { return dofs_; }

 private:
  using FEMatrix = Tpetra::FECrsMatrix<>;
  /// Positions in the matrix of the entries of one group of elements.
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
  Kokkos::View<const char*> constrained_, left_out_;
};

}  // namespace mudline
