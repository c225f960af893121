// Evaluations of a committed state outside of steps: F_n, static residual, rates and initial accelerations.
#include <algorithm>
#include <cmath>
#include <limits>

#include "integrator/overlap.hpp"
#include "integrator/stepper.hpp"

namespace mudline {

namespace {

StepRequest standing_still(bool inertia) {
  StepRequest request;
  request.dt = 1;  // no rate is evaluated with it
  request.scheme.inertia = inertia;
  request.scheme.flow = inertia;
  request.scheme.incremental = !inertia;
  request.prescribe = [](double, double, const State&, Constraints&) {};
  return request;
}

/// Adds time times rate to the unknowns [begin, end) of x that are not prescribed.
void move_on(const Constraints& constraints, const NodalView& rates, double time, int begin, int end, Vector& x) {
  const auto data = entries(x, Tpetra::Access::ReadWrite);
  const Kokkos::View<char*> prescribed = constraints.mask;
  const NodalView rate = rates;
  Kokkos::parallel_for(
      "first guess", Kokkos::RangePolicy<>(begin, end), KOKKOS_LAMBDA(int i) {
        if (!prescribed(i)) data(i) += time * rate(i);
      });
}

}  // namespace

Vector Stepper::extrapolated(const Vector& x) const {
  Vector result(x, Teuchos::Copy);
  const DofMap& dofs = *space_.dofs();
  for (int f = 0; f < space_.num_fields(); ++f)
    if (space_.field(f).time_order > 0)
      move_on(constraints_, store_.committed().rate, view_.dt, dofs.owned_begin(f), dofs.owned_end(f), result);
  return result;
}

double Stepper::misfit_of_rates(const StepRequest& request, const StepTolerances& tolerances) {
  StepRequest slow = request;
  slow.scheme = TimeScheme();
  slow.scheme.inertia = false;
  slow.scheme.incremental = true;
  StepRequest instant = slow;
  instant.dt *= 1e-6;
  const auto imbalance = [&](const StepRequest& step, bool moves, Vector& f) {
    Vector x = begin(step, tolerances);
    if (moves) x = extrapolated(x);
    return evaluate(x, false, f);
  };
  // a jump at the start of the stage, such as a sudden load, is no motion and is subtracted
  Vector jump(map()), resting(map()), moving(map());
  if (!imbalance(instant, false, jump) || !imbalance(slow, false, resting)) return 1;
  const std::vector<double> acting = convergence_.acting();
  if (!imbalance(slow, true, moving)) return 1;
  for (int f = 0; f < space_.num_fields(); ++f) {
    if (space_.field(f).time_order == 2) continue;
    const auto data = entries(jump, Tpetra::Access::ReadWrite);  // a flux at the start is a flux in the step, too
    for (int i = space_.dofs()->owned_begin(f); i < space_.dofs()->owned_end(f); ++i) data(i) = 0;
  }
  for (Vector* f : {&resting, &moving}) f->update(-1, jump, 1);
  const auto still = owned_field_norms(*space_.dofs(), resting), moved = owned_field_norms(*space_.dofs(), moving);
  double without = 0, with = 0;
  for (int f = 0; f < space_.num_fields(); ++f) {
    const double scale = std::max({acting[f], convergence_.acting()[f], 1e-300});
    without = std::max(without, still[f] / scale);
    with = std::max(with, moved[f] / scale);
  }
  return without > 0 ? with / without : (with > 0 ? std::numeric_limits<double>::infinity() : 1.0);
}

bool Stepper::refresh_history() {
  prepare_view(standing_still(false), StepView::Kind::rest);
  levels(owned_part(*space_.dofs(), store_.committed().value));
  int failures = 0;
  for (int k = 0; k < static_cast<int>(active_.size()); ++k) {
    const int slot = history_slot(k);
    if (slot < 0) continue;
    Term* term = active_[k];
    term->begin(view_);
    const NodalView force = store_.committed().history_forces[slot];
    Kokkos::deep_copy(force, 0.0);
    failures += term->residual(view_, force);
  }
  return sum_over_ranks(*space_.dofs()->comm(), failures) == 0;
}

NodalView Stepper::static_residual() {
  prepare_view(standing_still(false), StepView::Kind::rest);
  levels(owned_part(*space_.dofs(), store_.committed().value));
  for (Term* term : active_) term->begin(view_);
  evaluate_terms();
  return sum_overlap(*space_.dofs(), total_);
}

void Stepper::restore_solver(const std::vector<double>& memory) {
  const int any = memory.empty() ? 0 : 1;
  if (sum_over_ranks(*space_.dofs()->comm(), any) == 0) return;
  std::vector<double> solver = memory;
  chord_.restore(solver);
  solver_.restore(rcp(new CrsMatrix(*assembler_.matrix(), Teuchos::Copy)), solver);
}

std::vector<double> Stepper::solver_memory() {
  std::vector<double> memory = solver_.memory();
  forcing_.forget();
  if (memory.empty())
    chord_.forget();
  else
    chord_.save(memory);
  return memory;
}

void Stepper::levels_at_rest() {
  levels_.at_rest(store_.committed(), store_.trial());
  for (int f = 0; f < space_.num_fields(); ++f) {
    const bool second = space_.field(f).time_order == 2;
    view_.sensitivity[f] = {0, second ? 0.0 : 1.0, 0, second ? 1.0 : 0.0};
  }
  view_.momentum.geometry_weight = view_.balance.geometry_weight = 0;
}

void Stepper::add_rate_matrices() {
  assembler_.begin(constraints_.mask);
  for (int k = 0; k < static_cast<int>(active_.size()); ++k)
    if (history_slot(k) < 0) active_[k]->jacobian(view_, assembler_, 1.0);
  assembler_.end();
}

bool Stepper::hold_fields_without_rates() {
  bool held = false;
  Vector diagonal(map());
  assembler_.matrix()->getLocalDiagCopy(diagonal);
  const auto data = diagonal.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (int f = 0; f < space_.num_fields(); ++f) {
    double smallest = 1e300;
    for (int i = space_.dofs()->owned_begin(f); i < space_.dofs()->owned_end(f); ++i)
      if (!constraints_.mask(i)) smallest = std::min(smallest, std::abs(data(i, 0)));
    if (min_over_ranks(*space_.dofs()->comm(), smallest) > 1e-250) continue;
    held = true;
    for (const auto& [begin, end] : overlap_ranges(*space_.dofs(), f))
      for (int i = begin; i < end; ++i) constraints_.mask(i) = 1;
  }
  return held;
}

bool Stepper::initialise_rates(const StepRequest& request, double linear_tolerance) {
  prepare_view(standing_still(true), StepView::Kind::initial_rates);
  chord_.forget();
  constrain(request);
  levels_at_rest();
  for (Term* term : active_) term->begin(view_);
  if (sum_over_ranks(*space_.dofs()->comm(), evaluate_terms()) > 0) return false;
  add_rate_matrices();
  if (hold_fields_without_rates()) add_rate_matrices();
  for (std::size_t i = 0; i < total_.extent(0); ++i) total_(i) = constraints_.mask(i) ? 0.0 : -total_(i);
  Vector right(map()), y(map());
  export_overlap(*space_.dofs(), total_, right);
  if (right.norm2() == 0) return true;
  solver_.reset();
  solver_.set_matrix(assembler_.matrix(), [this] { return block_data_(view_); });
  const bool solved = solver_.solve(right, y, linear_tolerance).converged;
  solver_.reset();
  if (!solved) return false;
  State& state = store_.committed();
  NodalView result("initial rates", state.value.extent(0));
  import_owned(*space_.dofs(), y, result);
  for (int f = 0; f < space_.num_fields(); ++f)
    for (const auto& [begin, end] : overlap_ranges(*space_.dofs(), f))
      for (int i = begin; i < end; ++i)
        (space_.field(f).time_order == 2 ? state.acceleration : state.rate)(i) = result(i);
  return true;
}

}  // namespace mudline
