#include "integrator/step_system.hpp"

#include <algorithm>

#include "core/stopwatch.hpp"
#include "discretisation/agree.hpp"
#include "integrator/overlap.hpp"

namespace mudline {

namespace {

bool equal(const Vector& a, const Vector& b) {
  const auto here = entries(a, Tpetra::Access::ReadOnly), there = entries(b, Tpetra::Access::ReadOnly);
  int differences = 0;
  Kokkos::parallel_reduce(
      "equal", Kokkos::RangePolicy<>(0, here.extent(0)),
      KOKKOS_LAMBDA(int i, int& count) { count += here(i) == there(i) ? 0 : 1; }, differences);
  return differences == 0;
}

}  // namespace

StepSystem::StepSystem(const Space& space, StateStore& store, std::vector<Term*> terms, LinearSolver& solver,
                       std::function<BlockData(const StepView&)> block_data)
    : space_(space),
      store_(store),
      solver_(solver),
      block_data_(std::move(block_data)),
      terms_(space, store, std::move(terms)),
      frame_(space, store),
      convergence_(space, store),
      evaluated_(space.dofs()->owned()),
      balance_(space.dofs()->owned()) {
  convergence_.declare_state();
  activate(terms_.active());
}

void StepSystem::activate(const std::vector<Term*>& active) {
  terms_.activate(active);
  forget_solver();
  chord_.forget_all();  // a run that is continued from here knows no earlier stage
}

void StepSystem::forget_solver() {
  solver_.reset();
  chord_.forget();
  forcing_.forget();
}

void StepSystem::set_options(const NewtonOptions& newton) {
  chord_.enabled = newton.reuse_jacobian;
  forcing_.largest = newton.largest_forcing;
  elastic_share_.enabled = newton.elastic_share;
}

void StepSystem::start_solve() {
  forget_evaluation();
  chord_.start_solve();
  elastic_share_.start();
}

bool StepSystem::complete() {
  const int failures = sum_over_ranks(*space_.dofs()->comm(), terms_.complete(view()));
  if (failures > 0) failure_ = std::to_string(failures) + " points failed when the step was completed";
  return failures == 0;
}

bool StepSystem::residual(const Vector& x, Vector& f) {
  return evaluate(x, chord_.expects_jacobian(solver_.exact()), f);
}

bool StepSystem::evaluate(const Vector& x, bool jacobian_follows, Vector& f) {
  const Stopwatch watch(times_.residual);
  if (is_evaluated_at(x)) {  // the first guess is already evaluated, and Newton's method starts there
    Tpetra::deep_copy(f, balance_);
    return true;
  }
  evaluated_at_x_ = false;
  frame_.move_to(x);
  terms_.foresee_jacobian(jacobian_follows);
  const int failures = sum_over_ranks(*space_.dofs()->comm(), terms_.evaluate(view(), scheme().alpha_f));
  terms_.foresee_jacobian(false);
  failure_.clear();
  if (failures > 0) {
    failure_ = std::to_string(failures) + (failures == 1 ? " point" : " points") + " failed in " +
               broadcast(*space_.dofs()->comm(), terms_.failure());
    return false;
  }
  terms_.split_reactions(view());
  export_overlap(*space_.dofs(), terms_.total(), f);
  convergence_.measure(terms_.acting(), terms_.whole());
  Tpetra::deep_copy(evaluated_, x);
  Tpetra::deep_copy(balance_, f);
  evaluated_at_x_ = true;
  return true;
}

void StepSystem::check_chord() {
  const std::vector<double> key = frame_.matrix_key();
  if (sum_over_ranks(*space_.dofs()->comm(), chord_.belongs_to(key) ? 0 : 1) > 0) chord_.forget();
  chord_.start_step(key);
}

void StepSystem::use_matrix() {
  solver_.set_matrix(terms_.matrix(), [this] { return block_data_(view()); });
}

bool StepSystem::jacobian(const Vector& x) {
  if (chord_.may_reuse() && solver_.exact()) return true;
  {
    const Stopwatch watch(times_.jacobian);
    if (!is_evaluated_at(x)) terms_.forget_foreseen();
    evaluated_at_x_ = false;
    frame_.move_to(x);
    const std::string problem = terms_.add_matrices(view());
    frame_.linearised();
    if (!problem.empty()) {
      failure_ = problem;
      return false;
    }
    chord_.refreshed();
    convergence_.measure_rounding(*terms_.matrix(), x);
  }
  use_matrix();
  return true;
}

void StepSystem::apply_jacobian(const Vector& v, Vector& jv) { terms_.matrix()->apply(v, jv); }

bool StepSystem::solve(const Vector& f, Vector& dx) {
  const Stopwatch watch(times_.linear);
  const LinearReport report = solver_.solve(f, dx, {convergence_.linear_tolerance(), enough_});
  enough_.clear();
  linear_iterations_ += report.iterations;
  factorisations_ += report.factored ? 1 : 0;
  if (!report.converged) failure_ = "linear solver: " + report.reason;
  return report.converged;
}

bool StepSystem::solve_apart(const Vector& right, double tolerance, Vector& x) {
  solver_.reset();
  use_matrix();
  const bool solved = solver_.solve(right, x, tolerance).converged;
  solver_.reset();
  return solved;
}

void StepSystem::observe(double worst) {
  chord_.observe(worst, convergence_.observe());
  frame_.set_elastic_share(elastic_share_.next(worst));
  leave(solver_.iterative() ? forcing_.next(worst) : 0.0, worst);
}

void StepSystem::solve_roughly(const Vector& f) {
  const std::vector<double> ratios = residual_ratios(f);
  leave(solver_.iterative() ? forcing_.largest : 0.0, *std::max_element(ratios.begin(), ratios.end()));
}

void StepSystem::leave(double share, double worst) {
  enough_.clear();
  if (share > 0)
    for (const double limit : convergence_.limits()) enough_.push_back(share * worst * limit);
}

double StepSystem::work(const Vector& f, const Vector& dx) {
  const std::vector<double> works = owned_field_products(*space_.dofs(), f, dx), ratios = residual_ratios(f);
  double sum = 0, forces = 0, flows = 0;  // the latter two: residuals over their tolerances
  for (int field = 0; field < space_.num_fields(); ++field) {
    const bool moves = space_.field(field).time_order == 2;
    if (moves) sum += works[field];
    double& worst = moves ? forces : flows;
    worst = std::max(worst, ratios[field]);
  }
  return forces >= flows ? sum : 0;
}

Vector StepSystem::begin(const StepRequest& request, const StepTolerances& tolerances) {
  convergence_.begin_step(tolerances);
  linear_iterations_ = factorisations_ = 0;
  forget_evaluation();
  frame_.prepare(request, StepView::Kind::step);
  frame_.constrain(request);
  check_chord();
  forcing_.start_step();
  elastic_share_.start();
  enough_.clear();
  Vector x = frame_.start();
  frame_.move_to(x);
  terms_.begin(view());
  return x;
}

bool StepSystem::is_evaluated_at(const Vector& x) const {
  return sum_over_ranks(*space_.dofs()->comm(), evaluated_at_x_ && equal(evaluated_, x) ? 0 : 1) == 0;
}

void StepSystem::begin_rest() {
  forget_evaluation();
  frame_.prepare(standing_still(false), StepView::Kind::rest);
  frame_.move_to(owned_part(*space_.dofs(), store_.committed().value));
}

bool StepSystem::refresh_history() {
  begin_rest();
  return sum_over_ranks(*space_.dofs()->comm(), terms_.refresh_history(view())) == 0;
}

NodalView StepSystem::static_residual() {
  begin_rest();
  terms_.begin(view());
  terms_.evaluate(view(), scheme().alpha_f);
  return sum_overlap(*space_.dofs(), terms_.total());
}

void StepSystem::restore_solver(const std::vector<double>& memory) {
  const int any = memory.empty() ? 0 : 1;
  if (sum_over_ranks(*space_.dofs()->comm(), any) == 0) return;
  std::vector<double> solver = memory;
  chord_.restore(solver);
  solver_.restore(rcp(new CrsMatrix(*terms_.matrix(), Teuchos::Copy)), solver);
}

std::vector<double> StepSystem::solver_memory() {
  std::vector<double> memory = solver_.memory();
  forcing_.forget();
  if (memory.empty())
    chord_.forget_all();
  else
    chord_.save(memory);
  return memory;
}

}  // namespace mudline
