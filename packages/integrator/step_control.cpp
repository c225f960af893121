#include "integrator/step_control.hpp"

#include <algorithm>
#include <cmath>

#include "core/told.hpp"

namespace mudline {

void StepControl::parameters(Parameters& p) {
  p.required("initial", initial, "s", positive(), "first step of the stage");
  p.add("minimum", minimum, "s", non_negative(),
        "the run ends when a failing step would be cut below this; 0: initial * 1e-6");
  p.add("maximum", maximum, "s", non_negative(), "largest step; 0: the stage's duration");
  p.add("growth", growth, "-", closed(1, 10),
        "factor after an easy step; 1 keeps the initial step, to which it returns after a cut");
  p.add("cut", cut, "-", open(0, 1), "factor after a failed or a hard step");
  p.add("easy iterations", easy_iterations, "-", closed(1, 1000), "the step grows when Newton took no more iterations");
  p.add("hard iterations", hard_iterations, "-", closed(1, 1000),
        "the step shrinks when Newton took more iterations, unless a 'damped retry' succeeded");
  p.add("error tolerance", error_tolerance, "-", non_negative(),
        "local time error allowed per step, of each field (displacement with inertia, pore pressure, ...) relative to "
        "its largest size so far: chooses the step, and a step with more than twice the error is tried again with a "
        "shorter one; 0: off");
  p.add("maximum steps", maximum_steps, "-", closed(1, 1e9), "accepted steps before the stage is given up");
}

void StepControl::check(const Section& section) const {
  if (maximum > 0 && maximum < initial)
    section.fail("the maximum step, " + readable(maximum, "s") + ", must not be below the initial one, " +
                     readable(initial, "s"),
                 "maximum");
  if (minimum > initial)
    section.fail("the minimum step, " + readable(minimum, "s") + ", must not be above the initial one, " +
                     readable(initial, "s"),
                 "minimum");
  if (hard_iterations < easy_iterations) section.fail("must not be below 'easy iterations'", "hard iterations");
}

void StepControl::complete(double duration) {
  if (minimum <= 0) minimum = initial * 1e-6;
  if (maximum <= 0) maximum = std::max(duration, initial);
}

void LocalError::add(double field_ratio, int order) {
  ratio = std::max(ratio, field_ratio);
  if (!(field_ratio > 0)) return;
  factor = std::min(factor, 0.9 * std::pow(field_ratio, -1.0 / (order + 1)));
}

double StepControl::after_success(double dt, int iterations, const LocalError& error, bool retried) const {
  const bool hard = iterations > hard_iterations && !retried;
  double factor = 1;
  // after a cut the step grows slowly, or every second step would have the size that failed
  if (iterations <= easy_iterations) factor = growth == 1 && dt < initial ? std::min(1.25, initial / dt) : growth;
  if (hard) factor = cut;
  if (error_tolerance > 0) {
    // with a growth of 1 the error alone controls the step; without an error measure the step stays
    const double most = error.ratio >= 0 ? (growth > 1 ? growth : 2.0) : 1.0;
    const double wanted = std::clamp(error.factor, 0.25, most);
    factor = hard ? std::min(factor, wanted) : wanted;
  }
  return std::clamp(dt * factor, minimum, maximum);
}

double StepControl::after_error(double dt, const LocalError& error) const {
  if (error_tolerance <= 0 || error.ratio <= 2 || dt <= minimum * (1 + 1e-9)) return -1.0;
  return std::max(dt * std::clamp(error.factor, 0.1, 0.9), minimum);
}

double StepControl::after_failure(double dt) const {
  const double next = dt * cut;
  return next < minimum ? -1.0 : next;
}

double StepControl::steps_for(double duration, double dt) const {
  double steps = 0;
  for (; growth > 1 && dt < maximum && duration > 0; dt = std::min(maximum, growth * dt)) {
    duration -= dt;
    ++steps;
  }
  // a last part that is rounding is no step
  return steps + std::ceil(std::max(0.0, duration) / dt - 1e-9);
}

}  // namespace mudline
