#pragma once

#include "framework/constraints.hpp"
#include "framework/term.hpp"
#include "integrator/time_scheme.hpp"

namespace mudline {

/// The alpha levels of a step: values, rates and configurations at which terms are evaluated. Loops are kernels; the
/// committed state is only read.
class Levels {
 public:
  explicit Levels(const Space& space);
  /// Enters its arrays in the terms' view.
  void show(StepView& view) const;
  /// Computes rates, accelerations and coordinates of the trial state and all levels from trial.value.
  void of_step(const TimeScheme& scheme, const StepView& view, const State& old, const State& trial) const;
  /// Sets the given rates of prescribed unknowns in the trial state, and their mean acceleration over the step.
  void given_rates(const Constraints& constraints, const TimeScheme& scheme, double dt, const State& old,
                   const State& trial) const;
  /// Sets all levels to the committed state, with zero accelerations and first-order rates.
  void at_rest(const State& old, const State& trial) const;

 private:
  void configurations(const StepView& view, const State& old, const State& trial) const;

  const Space& space_;
  NodalView value_, rate_, velocity_, acceleration_, ahead_old_, ahead_end_;  // by overlap dof
  CoordinateView x_momentum_, x_balance_;
};

}  // namespace mudline
