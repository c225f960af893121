#pragma once

#include "core/function.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// Gravity as a vector times a function of time (a factor to switch it on).
struct Gravity {
  Point vector{};        // [m/s2]
  Function factor{1.0};  // function of time
  /// Unit vector against gravity; for zero gravity the last direction of the mesh.
  Point up(int dimension) const;
  Point at(double time) const {
    const double f = factor(time, {0, 0, 0});
    return {f * vector[0], f * vector[1], f * vector[2]};
  }
};

}  // namespace mudline
