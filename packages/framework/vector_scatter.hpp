#pragma once

#include "framework/term.hpp"

namespace mudline {

/// Target to which the elements or sides of a loop add their vectors.
struct VectorScatter {
  ResidualView to;
  ElementDofs dofs;
  int pieces = 1;             // number of separate additions of an element to a row, in order
  ElementBuffer buffer = {};  // for loops on several threads: (element of the batch, row, four numbers per piece)

  /// Adds a sum and its sizes before cancellation to row a of element e's vector. Called within in_order().
  KOKKOS_INLINE_FUNCTION void add(int e, int a, double sum, double acting, double whole, int piece = 0) const {
    if (!buffer.used()) return to.add(dofs(e, a), sum, acting, whole);
    double* const kept = &buffer.values(e - buffer.first, a, numbers * piece);
    kept[0] = sum;
    kept[1] = acting;
    kept[2] = whole;
  }

  /// Adds a flow that passes through the open unknown of row a. Called within in_order().
  KOKKOS_INLINE_FUNCTION void pass(int e, int a, double flow) const {
    if (!buffer.used()) return to.pass(dofs(e, a), flow);
    buffer.values(e - buffer.first, a, 3) = flow;
  }

  // Interface for in_order().
  void open_buffer(int elements) {
    buffer.values = decltype(buffer.values)(Kokkos::view_alloc("element vectors", Kokkos::WithoutInitializing),
                                            elements, dofs.extent(1), numbers * pieces);
  }
  /// Called before element e adds: clears its part of the buffer.
  KOKKOS_INLINE_FUNCTION void open(int e) const {
    if (!buffer.used()) return;
    for (int a = 0; a < static_cast<int>(dofs.extent(1)); ++a)
      for (int n = 0; n < numbers * pieces; ++n) buffer.values(e - buffer.first, a, n) = 0;
  }
  KOKKOS_INLINE_FUNCTION void take(int row, int entry) const {
    const int columns = static_cast<int>(dofs.extent(1));
    const double* const kept = &buffer.values(entry / columns, entry % columns, 0);
    for (int piece = 0; piece < pieces; ++piece) {
      const double* const part = kept + numbers * piece;
      to.add(row, part[0], part[1], part[2]);
      if (part[3] != 0) to.pass(row, part[3]);
    }
  }

 private:
  static constexpr int numbers = 4;  // of a piece: sum, acting, whole, passing
};

}  // namespace mudline
