#pragma once

#include "framework/state.hpp"

namespace mudline {

/// Prescribed unknowns of a step, by overlap dof; consistent across ranks.
struct Constraints {
  Kokkos::View<char*> mask;   // 1: prescribed
  Kokkos::View<char*> open;   // 1: pore pressure at a boundary that is open to water of a given pressure
  NodalView value;            // prescribed value, or that of the water outside, at t_{n+1}
  Kokkos::View<char*> moves;  // 1: its rate is given as well
  NodalView rate;             // given rate at t_{n+1}, per second

  Constraints() = default;
  /// Makes room for this many unknowns, none of them prescribed.
  explicit Constraints(int dofs)
      : mask("prescribed", dofs), open("open", dofs), value("value", dofs), moves("moves", dofs), rate("rate", dofs) {}
  /// Whether an unknown, or the pressure of the water outside it, is given.
  KOKKOS_INLINE_FUNCTION bool given(int dof) const { return mask(dof) || open(dof); }
  KOKKOS_INLINE_FUNCTION void prescribe(int dof, double to) const {
    mask(dof) = 1;
    value(dof) = to;
  }
  /// Opens the boundary at a pore pressure to water of the pressure `outside` [Pa].
  KOKKOS_INLINE_FUNCTION void open_to(int dof, double outside) const {
    open(dof) = 1;
    value(dof) = outside;
  }
  /// Prescribes the value and the known rate of a motion. A rate that the integrator derives from the values would
  /// oscillate after every kink of the motion.
  KOKKOS_INLINE_FUNCTION void prescribe(int dof, double to, double at_rate) const {
    prescribe(dof, to);
    moves(dof) = 1;
    rate(dof) = at_rate;
  }
};

}  // namespace mudline
