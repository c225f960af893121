#pragma once

#include "framework/term.hpp"
#include "integrator/step_control.hpp"
#include "integrator/time_scheme.hpp"

namespace mudline {

/// Local time error of a step, estimated from the change of the rates over it. The error of a field's values x in a
/// step of length dt is
///   second order with inertia, from the accelerations a:  dt^2 (|1/6 - s/2 - beta| + |gamma + s - 1/2|) |a_{n+1} -
///   a_n| (Zienkiewicz and Xie 1991; s = alpha_m - alpha_f, by which the algorithm's accelerations run ahead; ~ dt^3),
///   first order, from the second and third derivatives of differenced rates: dt^2 |theta + s - 1/2| |x''| (~ dt^2),
///   dt^3 |.| |x'''| (~ dt^3) where theta makes the former vanish.
/// Displacements without inertia follow loads and pore pressures at once and have no time error of their own.
class TimeError {
 public:
  explicit TimeError(const Space& space) : space_(space) {}
  /// Error of the step that `view` holds at its solution, before it is accepted, in units of `tolerance` relative to
  /// `sizes`, the largest norms of the fields' values so far. `dt_old` [s]: length of the previous step; `step`: number
  /// within the stage, from 0. The first steps are not measured, because a load that jumps at the start of the stage
  /// affects their rates. Stores the second derivatives of first-order fields in the trial accelerations for the next
  /// step. Prescribed unknowns have no error. Collective.
  LocalError measure(const StepView& view, const TimeScheme& scheme, double dt_old, int step,
                     const std::vector<double>& sizes, double tolerance) const;
  /// Whether a step of this scheme integrates any field of the model in time.
  static bool has_meaning(const Space& space, const TimeScheme& scheme);

 private:
  const Space& space_;
};

}  // namespace mudline
