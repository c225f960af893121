#pragma once

#include <string>

#include "framework/term_faces.hpp"
#include "integrator/newton.hpp"
#include "integrator/step_system.hpp"

namespace mudline {

/// Outcome of an attempted step.
struct StepReport {
  bool converged = false;
  bool refused = false;       // a term refused the step, though Newton's method converged
  int newton_iterations = 0;  // over all solves of the step
  int hardest_solve = 0;      // largest number of iterations of one solve
  int augmentations = 0;      // solves after the first, for terms that augment
  int linear_iterations = 0;
  int factorisations = 0;
  bool on_trial = false;  // began with a first guess on trial
  bool retried = false;   // full steps did not converge, another way may have
  std::string reason;
};

/// One step as a transaction: begin (predictor, search) -> first guess -> Newton on pure evaluations, repeated where
/// terms augment -> a complete trial state or nothing. The committed state is untouched.
class Stepper {
 public:
  /// `system` must outlive it.
  explicit Stepper(StepSystem& system) : system_(system) {}
  /// Tries one step from the committed state in the ways of the options (NewtonOptions::ways); where it does not
  /// converge from a guess on trial, once more without it. On success the trial state is complete. Collective.
  StepReport attempt(const StepRequest& request, const StepTolerances& tolerances, const NewtonOptions& newton);

 private:
  /// One attempt with these Newton options only, without a damped retry.
  StepReport try_step(const StepRequest& request, const StepTolerances& tolerances, const NewtonOptions& newton);
  /// Solves from x, repeatedly where terms augment; on convergence the trial state belongs to x, bit for bit.
  void solve_step(const NewtonOptions& newton, Vector& x, StepReport& report);
  /// Augmentation of all active terms. Collective.
  Augmentation augment(int count);

  StepSystem& system_;
};

}  // namespace mudline
