#pragma once

#include <string>

#include "core/parameters.hpp"

namespace mudline {

/// Size of the steps of one stage: iteration-controlled, optionally error-controlled, cut on failure.
struct StepControl {
  double initial = 0;        // [s]
  double minimum = 0;        // [s] 0: initial * 1e-6
  double maximum = 0;        // [s] 0: the stage's duration
  double growth = 1.0;       // after an easy step; 1: constant steps
  double cut = 0.5;          // after a failed one
  int easy_iterations = 6;   // grow when Newton took no more
  int hard_iterations = 10;  // shrink by `cut` when it took more
  double error_tolerance = 0;  // relative local error of displacement and pressure; 0: off
  int maximum_steps = 1000000;

  void parameters(Parameters& p);
  void check(const Section& section) const;
  /// Fills the defaults that depend on the duration.
  void complete(double duration);
  /// Next step after success. `error`: local error divided by its tolerance (0 when not measured).
  double after_success(double dt, int iterations, double error) const;
  /// Next step after failure; negative when it would be below the minimum.
  double after_failure(double dt) const;
};

}  // namespace mudline
