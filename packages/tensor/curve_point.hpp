#pragma once

#include "tensor/vec.hpp"

namespace mudline {

/// A curve's point at one parameter t, with its derivatives by t.
template <int D>
struct CurvePoint {
  Vec<double, D> x, d, dd;  // [m]
};

}  // namespace mudline
