#pragma once

#include "framework/term.hpp"

namespace mudline {

/// Target to which the elements or sides of a loop add their vectors.
struct VectorScatter {
  ResidualView to;
  ElementDofs dofs;
  int pieces = 1;             // number of separate additions of an element to a row, in order
  ElementBuffer buffer = {};  // for loops on several threads: (element of the batch, row, three numbers per piece)

  /// Adds a sum and its sizes before cancellation to row a of element e's vector. Called within in_order().
  KOKKOS_INLINE_FUNCTION void add(int e, int a, double sum, double acting, double whole, int piece = 0) const {
    if (!buffer.used()) return to.add(dofs(e, a), sum, acting, whole);
    double* const kept = &buffer.values(e - buffer.first, a, 3 * piece);
    kept[0] = sum;
    kept[1] = acting;
    kept[2] = whole;
  }

  // Interface for in_order().
  void open_buffer(int elements) {
    buffer.values = decltype(buffer.values)(Kokkos::view_alloc("element vectors", Kokkos::WithoutInitializing),
                                            elements, dofs.extent(1), 3 * pieces);
  }
  /// Called before element e adds: clears its part of the buffer.
  KOKKOS_INLINE_FUNCTION void open(int e) const {
    if (!buffer.used()) return;
    for (int a = 0; a < static_cast<int>(dofs.extent(1)); ++a)
      for (int n = 0; n < 3 * pieces; ++n) buffer.values(e - buffer.first, a, n) = 0;
  }
  KOKKOS_INLINE_FUNCTION void take(int row, int entry) const {
    const int columns = static_cast<int>(dofs.extent(1));
    const double* const kept = &buffer.values(entry / columns, entry % columns, 0);
    for (int piece = 0; piece < pieces; ++piece) to.add(row, kept[3 * piece], kept[3 * piece + 1], kept[3 * piece + 2]);
  }
};

}  // namespace mudline
