#pragma once

#include "framework/constraints.hpp"
#include "framework/term.hpp"
#include "integrator/time_scheme.hpp"

namespace mudline {

/// What lies between the two ends of a step: the values, rates and configurations at which terms are evaluated.
/// Loops are kernels; the committed state is only read.
class Levels {
 public:
  explicit Levels(const Space& space);
  /// Hands its arrays to the terms' view.
  void show(StepView& view) const;
  /// From trial.value: rates, accelerations and coordinates of the trial state, and all levels.
  void of_step(const TimeScheme& scheme, const StepView& view, const State& old, const State& trial) const;
  /// Prescribed unknowns whose rates are given have those, and over the step their mean acceleration.
  void given_rates(const Constraints& constraints, const TimeScheme& scheme, double dt, const State& old,
                   const State& trial) const;
  /// All levels are the committed state: no acceleration, no rates of first order.
  void at_rest(const State& old, const State& trial) const;

 private:
  void configurations(const StepView& view, const State& old, const State& trial) const;

  const Space& space_;
  NodalView value_, rate_, velocity_, acceleration_, ahead_old_, ahead_end_;  // by overlap dof
  CoordinateView x_momentum_, x_balance_;
};

}  // namespace mudline
