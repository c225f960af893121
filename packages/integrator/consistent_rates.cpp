#include "integrator/consistent_rates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrator/first_guess.hpp"
#include "integrator/overlap.hpp"

namespace mudline {

namespace {

/// Prescribes the fields whose rate matrix has a zero row, so that it is singular. Returns whether there are any.
bool hold_fields_without_rates(const StepSystem& system) {
  const DofMap& dofs = *system.space().dofs();
  const Constraints& constraints = system.constraints();
  bool held = false;
  Vector diagonal(system.map());
  system.terms().matrix()->getLocalDiagCopy(diagonal);
  const auto data = diagonal.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (int f = 0; f < system.space().num_fields(); ++f) {
    double smallest = 1e300;
    for (int i = dofs.owned_begin(f); i < dofs.owned_end(f); ++i)
      if (!constraints.mask(i)) smallest = std::min(smallest, std::abs(data(i, 0)));
    if (min_over_ranks(*dofs.comm(), smallest) > 1e-250) continue;
    held = true;
    for (const auto& [begin, end] : overlap_ranges(dofs, f))
      for (int i = begin; i < end; ++i) constraints.mask(i) = 1;
  }
  return held;
}

/// Evaluates the terms at the start of `request`, with zero accelerations and first-order rates. Returns false if they
/// cannot be evaluated. Collective.
bool evaluate_at_rest(StepSystem& system, const StepRequest& request) {
  system.forget_evaluation();
  system.forget_jacobian();
  system.frame().prepare(standing_still(true), StepView::Kind::initial_rates);
  system.frame().constrain(request);
  system.frame().rest();
  ActingTerms& terms = system.terms();
  terms.begin(system.view());
  return sum_over_ranks(*system.space().dofs()->comm(), terms.evaluate(system.view(), system.scheme().alpha_f)) == 0;
}

/// Solves for the rates and accelerations of the unknowns that are not constrained. Collective.
bool solve_rates(StepSystem& system, double tolerance, Vector& rates) {
  const NodalView total = system.terms().total();
  const Constraints& constraints = system.constraints();
  for (std::size_t i = 0; i < total.extent(0); ++i) total(i) = constraints.mask(i) ? 0.0 : -total(i);
  Vector right(system.map());
  export_overlap(*system.space().dofs(), total, right);
  rates.putScalar(0);
  return right.norm2() == 0 || system.solve_apart(right, tolerance, rates);
}

}  // namespace

bool give_consistent_rates(StepSystem& system, const StepRequest& request, double linear_tolerance) {
  if (!evaluate_at_rest(system, request)) return false;
  system.terms().add_rate_matrices(system.view());
  if (hold_fields_without_rates(system)) system.terms().add_rate_matrices(system.view());
  Vector rates(system.map());
  if (!solve_rates(system, linear_tolerance, rates)) return false;
  if (rates.norm2() == 0) return true;
  const Space& space = system.space();
  const State& state = system.store().committed();
  NodalView result("initial rates", state.value.extent(0));
  import_owned(*space.dofs(), rates, result);
  for (int f = 0; f < space.num_fields(); ++f)
    for (const auto& [begin, end] : overlap_ranges(*space.dofs(), f))
      for (int i = begin; i < end; ++i)
        (space.field(f).time_order == 2 ? state.acceleration : state.rate)(i) = result(i);
  return true;
}

double misfit_of_rates(StepSystem& system, const StepRequest& request, const StepTolerances& tolerances) {
  StepRequest slow = request;
  slow.scheme = TimeScheme();
  slow.scheme.inertia = false;
  slow.scheme.incremental = true;
  StepRequest instant = slow;
  instant.dt *= 1e-6;
  const auto imbalance = [&](const StepRequest& step, bool moves, Vector& f) {
    Vector x = system.begin(step, tolerances);
    if (moves) x = extrapolated(system, x, system.store().committed().rate);
    return system.evaluate(x, false, f);
  };
  // a jump at the start of the stage, such as a sudden load, is no motion and is subtracted
  Vector jump(system.map()), resting(system.map()), moving(system.map());
  if (!imbalance(instant, false, jump) || !imbalance(slow, false, resting)) return 1;
  const std::vector<double> acting = system.convergence().acting();
  if (!imbalance(slow, true, moving)) return 1;
  const Space& space = system.space();
  const DofMap& dofs = *space.dofs();
  for (int f = 0; f < space.num_fields(); ++f) {
    if (space.field(f).time_order == 2) continue;
    const auto data = entries(jump, Tpetra::Access::ReadWrite);  // a flux at the start is a flux in the step, too
    for (int i = dofs.owned_begin(f); i < dofs.owned_end(f); ++i) data(i) = 0;
  }
  for (Vector* f : {&resting, &moving}) f->update(-1, jump, 1);
  const std::vector<double>& now_acting = system.convergence().acting();
  const double without = largest_ratio(owned_field_norms(dofs, resting), acting, now_acting);
  const double with = largest_ratio(owned_field_norms(dofs, moving), acting, now_acting);
  return without > 0 ? with / without : (with > 0 ? std::numeric_limits<double>::infinity() : 1.0);
}

}  // namespace mudline
