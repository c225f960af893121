#pragma once

#include <string>

#include "core/parameters.hpp"

namespace mudline {

/// Local time error of a step over its tolerance, and the step size that follows from it.
struct LocalError {
  double ratio = -1;      // largest over the fields; negative: not measured
  double factor = 1e300;  // factor by which the step meets the tolerance in the most demanding field

  /// Adds a field whose error is ~ dt^(order + 1).
  void add(double field_ratio, int order);
};

/// Size of the steps of one stage: iteration-controlled, optionally error-controlled, cut on failure.
struct StepControl {
  double initial = 0;          // [s]
  double minimum = 0;          // [s] 0: initial * 1e-6
  double maximum = 0;          // [s] 0: the stage's duration
  double growth = 1.0;         // after an easy step; 1: constant steps
  double cut = 0.5;            // after a failed one
  int easy_iterations = 6;     // grow when Newton took no more
  int hard_iterations = 10;    // shrink by `cut` when it took more
  double error_tolerance = 0;  // relative local error of the fields; 0: off
  int maximum_steps = 1000000;

  void parameters(Parameters& p);
  void check(const Section& section) const;
  /// Fills the defaults that depend on the duration.
  void complete(double duration);
  /// Next step after success. A `retried` step keeps its size however many iterations it took: soil that snaps to
  /// another equilibrium does so in any step.
  double after_success(double dt, int iterations, const LocalError& error, bool retried = false) const;
  /// Step that replaces a converged one whose local error is too large; negative if the converged one is to be
  /// accepted. A step at the minimum is accepted, because no step is short enough where a load jumps.
  double after_error(double dt, const LocalError& error) const;
  /// Number of steps that a duration [s] takes from a step of `dt` on if all are easy and none is limited by its error.
  double steps_for(double duration, double dt) const;
  /// Next step after failure; negative if it would be below the minimum.
  double after_failure(double dt) const;
};

}  // namespace mudline
