#pragma once

#include "framework/state.hpp"

namespace mudline {

/// Prescribed unknowns of a step, by overlap dof; consistent across ranks.
struct Constraints {
  Kokkos::View<char*> mask;  // 1: prescribed
  NodalView value;           // prescribed value at t_{n+1}

  Constraints() = default;
  /// Of so many unknowns, none of them prescribed.
  explicit Constraints(int dofs) : mask("prescribed", dofs), value("prescribed value", dofs) {}
  void prescribe(int dof, double to) const {
    mask(dof) = 1;
    value(dof) = to;
  }
};

}  // namespace mudline
