#pragma once

#include "integrator/step_system.hpp"

namespace mudline {

/// Gives the committed state the accelerations and first-order rates that satisfy the equations of motion (start of a
/// dynamic stage). Fields whose rate matrix is singular (incompressible constituents) keep the rate zero. `request`:
/// the first step. Returns false, with the state unchanged, where they cannot be computed. Collective.
bool give_consistent_rates(StepSystem& system, const StepRequest& request, double linear_tolerance);

/// Measures whether the committed rates continue into a stage: the ratio of two relative imbalances at the end of a
/// step without inertia under its loads and motions, one with the committed rates and one at rest. It is small where
/// something moves and the rates are its velocities, infinite where nothing moves and the rates are remnants of
/// earlier loads, and 1 where it cannot be evaluated. Collective.
double misfit_of_rates(StepSystem& system, const StepRequest& request, const StepTolerances& tolerances);

}  // namespace mudline
