#include "integrator/time_error.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/ordered_sum.hpp"
#include "integrator/overlap.hpp"

namespace mudline {

namespace {

/// Coefficients of the leading terms of a first-order field's error.
struct FirstOrderError {
  double second, third;  // coefficients of dt^2 x'' and dt^3 x'''

  explicit FirstOrderError(const TimeScheme& t) {
    if (t.incremental) {
      second = std::abs(t.theta - 0.5);
      third = std::abs(0.5 * t.theta - 1.0 / 6);
      return;
    }
    // the algorithm's rates belong to instants s dt later, except for a share of dt^2 x''' by which the interpolations
    // of values and rates differ
    const double af = t.flow_alpha_f, am = t.flow_alpha_m, s = af - am;
    const double interpolation = 0.5 * (af * (1 - af) - am * (1 - am));
    second = std::abs(t.theta + s - 0.5);
    third = std::abs(0.5 * (s * s + t.theta * (1 + 2 * s)) + interpolation - 1.0 / 6);
  }
};

/// Squares of factor (now - old) at the unknowns that are not prescribed.
struct SquaresOfError {
  double factor;
  ConstNodalView now, old;  // an empty `old` is zero
  Kokkos::View<const char*> constrained;
  KOKKOS_FUNCTION void operator()(int i, double (&sum)[1]) const {
    if (constrained(i)) return;
    const double error = factor * (now(i) - (old.extent(0) > 0 ? old(i) : 0.0));
    sum[0] += error * error;
  }
};

/// Second derivatives from the rates of two instants.
void differentiate(const NodalView& now, const NodalView& old, double between, int begin, int end,
                   const NodalView& to) {
  const NodalView rate = now, rate_old = old, derivative = to;
  Kokkos::parallel_for(
      "second derivatives", Kokkos::RangePolicy<>(begin, end),
      KOKKOS_LAMBDA(int i) { derivative(i) = (rate(i) - rate_old(i)) / between; });
}

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
  const auto judge = [&](int field, int order, double factor, const NodalView& of, const NodalView& less) {
    const double squares = ordered_sum<1>("time error", dofs.owned_begin(field), dofs.owned_end(field),
                                          SquaresOfError{factor, of, less, view.constrained})[0];
    const double error = std::sqrt(sum_over_ranks(*dofs.comm(), squares));
    if (sizes[field] > 0) result.add(error / (sizes[field] * tolerance), order);
  };
  for (int f = 0; f < space_.num_fields(); ++f) {
    if (space_.field(f).time_order == 2) {
      if (!scheme.inertia || step < 1) continue;
      const double s = scheme.alpha_m - scheme.alpha_f;
      const double c = std::abs(1.0 / 6 - 0.5 * s - scheme.beta) + std::abs(scheme.gamma + s - 0.5);
      judge(f, 2, c * dt * dt, now.acceleration, old.acceleration);
      continue;
    }
    if (!scheme.flow) continue;
    for (const auto& range : overlap_ranges(dofs, f))
      if (step < 2)
        Kokkos::deep_copy(Kokkos::subview(now.acceleration, range), 0.0);
      else
        differentiate(now.rate, old.rate, rates, range.first, range.second, now.acceleration);
    if (step < 2) continue;
    judge(f, 1, first.second * dt * dt, now.acceleration, {});
    if (step < 3) continue;
    judge(f, 2, first.third * std::pow(dt, 3) / derivatives, now.acceleration, old.acceleration);
  }
  return result;
}

}  // namespace mudline
