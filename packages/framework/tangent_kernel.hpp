#pragma once

#include "algebra/assembler.hpp"

namespace mudline {

/// What runs on every element or side of a loop: adds weight times the derivative of a law's balance to the matrix.
template <class Loop, class Law>
struct TangentKernel {
  Loop loop;
  Law law;
  MatrixScatter to;
  double weight;
  KOKKOS_INLINE_FUNCTION void operator()(int i) const { loop.tangent(i, law, to, weight); }
};
template <class Loop, class Law>
TangentKernel(Loop, Law, MatrixScatter, double) -> TangentKernel<Loop, Law>;

}  // namespace mudline
