#pragma once

#include "framework/field_block.hpp"
#include "framework/term.hpp"

namespace mudline {

/// The state on which a loop works: coordinates and fields at one level, and their sensitivities to the unknowns.
struct LoopLevel {
  ConstCoordinateView x;                // [m]
  ConstNodalView value_old, value_end;  // of the step; coordinates move by geometry_weight times their difference
  ConstNodalView value, rate, acceleration;
  Kokkos::View<const char*> open;  // see StepView; empty: no unknown is open
  ConstNodalView outside;
  double geometry_weight = 0;  // d x / d u_{n+1}
  Sensitivity displacement, scalar[max_scalars];

  // Not inline: every kernel copies its level, and counting the references of six arrays is much code.
  LoopLevel();
  LoopLevel(const LoopLevel&);
  LoopLevel& operator=(const LoopLevel&);
  ~LoopLevel();
};

/// The state at one of the levels of a step.
LoopLevel loop_level(const StepView& view, const Level& level, const FieldBlock& block);

/// The state at the end of the step, where state variables live. In the solve for the initial rates of a stage the
/// coordinates do not depend on the unknowns.
LoopLevel end_level(const StepView& view, const FieldBlock& block);

/// A state by itself, outside of a step: no sensitivities.
LoopLevel level_of(const State& state);

}  // namespace mudline
