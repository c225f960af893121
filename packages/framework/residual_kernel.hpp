#pragma once

#include "framework/vector_scatter.hpp"

namespace mudline {

/// Kernel for one element of a loop with residual(e, to): the counterpart of TangentKernel.
template <class Loop>
struct ResidualKernel {
  Loop loop;
  VectorScatter to;
  KOKKOS_INLINE_FUNCTION void operator()(int e) const {
    to.open(e);
    loop.residual(e, to);
  }
};

/// Runs ResidualKernel on `elements` elements with these dofs and their row lists.
template <class Loop>
void add_residuals(const char* label, const RowLists& rows, int elements, const ElementDofs& dofs, const Loop& loop,
                   const ResidualView& f) {
  in_order("residual rows", rows, 0, elements, VectorScatter{f, dofs},
           [&](int first, int last, const VectorScatter& to) {
             Kokkos::parallel_for(label, Kokkos::RangePolicy<>(first, last), ResidualKernel<Loop>{loop, to});
           });
}

}  // namespace mudline
