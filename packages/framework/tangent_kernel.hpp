#pragma once

#include "algebra/assembler.hpp"

namespace mudline {

/// Kernel for one element or side of a loop: adds weight times the derivative of a law's balance to the matrix.
template <class Loop, class Law>
struct TangentKernel {
  Loop loop;
  Law law;
  MatrixScatter to;
  double weight;
  KOKKOS_INLINE_FUNCTION void operator()(int i) const {
    to.open(i);
    loop.tangent(i, law, to, weight);
  }
};
template <class Loop, class Law>
TangentKernel(Loop, Law, MatrixScatter, double) -> TangentKernel<Loop, Law>;

/// Runs TangentKernel on elements or sides [first, last) of a group; `first` is the start of a batch.
template <class Loop, class Law>
void add_tangents(const char* label, const RowLists& rows, int first, int last, const Loop& loop, const Law& law,
                  const MatrixScatter& to, double weight) {
  in_order("matrix rows", rows, first, last, to, [&](int begin, int end, const MatrixScatter& target) {
    Kokkos::parallel_for(label, Kokkos::RangePolicy<>(begin, end), TangentKernel{loop, law, target, weight});
  });
}

}  // namespace mudline
