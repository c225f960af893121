#include "integrator/time_error.hpp"

#include <algorithm>
#include <cmath>

#include "integrator/overlap.hpp"

namespace mudline {

namespace {

/// Coefficients of the leading terms of a first-order field's error.
struct FirstOrderError {
  double second, third;  // of dt^2 x'' and dt^3 x'''

  explicit FirstOrderError(const TimeScheme& t) {
    if (t.incremental) {
      second = std::abs(t.theta - 0.5);
      third = std::abs(0.5 * t.theta - 1.0 / 6);
      return;
    }
    // the algorithm's rates are those of instants s dt later, but for a share of dt^2 x''' by which the interpolations
    // of values and rates differ
    const double af = t.flow_alpha_f, am = t.flow_alpha_m, s = af - am;
    const double interpolation = 0.5 * (af * (1 - af) - am * (1 - am));
    second = std::abs(t.theta + s - 0.5);
    third = std::abs(0.5 * (s * s + t.theta * (1 + 2 * s)) + interpolation - 1.0 / 6);
  }
};

}  // namespace

bool TimeError::has_meaning(const Space& space, const TimeScheme& scheme) {
  for (int f = 0; f < space.num_fields(); ++f)
    if (space.field(f).time_order == 1 ? scheme.flow : scheme.inertia) return true;
  return false;
}

LocalError TimeError::measure(const StepView& view, const TimeScheme& scheme, double dt_old, int step,
                              const std::vector<double>& sizes, double tolerance) const {
  const DofMap& dofs = *space_.dofs();
  const State& old = *view.committed;
  State& now = *view.trial;
  const double dt = view.dt;
  const FirstOrderError first(scheme);
  // distances between the instants of the last two rates (a difference over a step is the rate at t_n + theta dt) and
  // between those of the last two second derivatives
  const double rates = scheme.incremental ? scheme.theta * dt + (1 - scheme.theta) * dt_old : dt;
  const double derivatives = 0.5 * (scheme.incremental ? scheme.theta * dt + (2 - scheme.theta) * dt_old : dt + dt_old);
  LocalError result;
  const auto judge = [&](int field, int order, const auto& error_of) {
    double sum = 0;
    for (int i = dofs.owned_begin(field); i < dofs.owned_end(field); ++i)
      if (!view.constrained(i)) sum += std::pow(error_of(i), 2);
    const double error = std::sqrt(sum_over_ranks(*dofs.comm(), sum));
    if (sizes[field] > 0) result.add(error / (sizes[field] * tolerance), order);
  };
  for (int f = 0; f < space_.num_fields(); ++f) {
    if (space_.field(f).time_order == 2) {
      if (!scheme.inertia || step < 1) continue;
      const double s = scheme.alpha_m - scheme.alpha_f;
      const double c = std::abs(1.0 / 6 - 0.5 * s - scheme.beta) + std::abs(scheme.gamma + s - 0.5);
      judge(f, 2, [&](int i) { return c * dt * dt * (now.acceleration(i) - old.acceleration(i)); });
      continue;
    }
    if (!scheme.flow) continue;
    for (const auto& [begin, end] : overlap_ranges(dofs, f))
      for (int i = begin; i < end; ++i) now.acceleration(i) = step < 2 ? 0.0 : (now.rate(i) - old.rate(i)) / rates;
    if (step < 2) continue;
    judge(f, 1, [&](int i) { return first.second * dt * dt * now.acceleration(i); });
    if (step < 3) continue;
    judge(f, 2, [&](int i) {
      return first.third * std::pow(dt, 3) * (now.acceleration(i) - old.acceleration(i)) / derivatives;
    });
  }
  return result;
}

}  // namespace mudline
