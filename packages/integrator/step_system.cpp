#include "integrator/step_system.hpp"

#include <KokkosBlas1_axpby.hpp>
#include <KokkosBlas1_update.hpp>

#include <algorithm>

#include "core/foreign_library.hpp"
#include "core/guarded.hpp"
#include "core/stopwatch.hpp"
#include "discretisation/agree.hpp"
#include "integrator/overlap.hpp"

namespace mudline {

namespace {

bool finite(const NodalView& values) {
  double sum = 0;  // NaN where one is not finite
  Kokkos::parallel_reduce(
      "finite", Kokkos::RangePolicy<>(0, values.extent(0)),
      KOKKOS_LAMBDA(int i, double& part) { part += 0.0 * values(i); }, sum);
  return sum == 0.0;
}

bool equal(const Vector& a, const Vector& b) {
  const auto here = entries(a, Tpetra::Access::ReadOnly), there = entries(b, Tpetra::Access::ReadOnly);
  int differences = 0;
  Kokkos::parallel_reduce(
      "equal", Kokkos::RangePolicy<>(0, here.extent(0)),
      KOKKOS_LAMBDA(int i, int& count) { count += here(i) == there(i) ? 0 : 1; }, differences);
  return differences == 0;
}

/// The request of an evaluation at rest.
StepRequest standing_still(bool inertia) {
  StepRequest request;
  request.dt = 1;  // no rate is evaluated with it
  request.scheme.inertia = inertia;
  request.scheme.flow = inertia;
  request.scheme.incremental = !inertia;
  request.prescribe = [](double, double, const State&, Constraints&) {};
  return request;
}

/// Fills x with the prescribed values and, for free unknowns, the given values.
void start_from(const Constraints& constraints, const NodalView& values, Vector& x) {
  const auto data = entries(x, Tpetra::Access::OverwriteAll);
  const Constraints given = constraints;
  const NodalView otherwise = values;
  Kokkos::parallel_for(
      "start values", Kokkos::RangePolicy<>(0, data.extent(0)),
      KOKKOS_LAMBDA(int i) { data(i) = given.mask(i) ? given.value(i) : otherwise(i); });
}

/// Prescribes the unknowns [begin, end) at their present values.
void hold(const Constraints& constraints, const NodalView& values, int begin, int end) {
  const Constraints to = constraints;
  const NodalView from = values;
  Kokkos::parallel_for(
      "hold", Kokkos::RangePolicy<>(begin, end), KOKKOS_LAMBDA(int i) { to.prescribe(i, from(i)); });
}

/// Moves the forces at prescribed unknowns from the total to the reactions; that of an open one is the flow that
/// passes.
void split_reactions(const Constraints& constraints, const NodalView& passing, const NodalView& total,
                     const NodalView& reaction) {
  const Kokkos::View<char*> prescribed = constraints.mask;
  Kokkos::parallel_for(
      "reactions", Kokkos::RangePolicy<>(0, total.extent(0)), KOKKOS_LAMBDA(int i) {
        reaction(i) = prescribed(i) ? total(i) : passing(i);
        if (prescribed(i)) total(i) = 0;
      });
}

/// What is exchanged at the boundary with an open unknown passes through it.
void pass_on(const Constraints& constraints, const NodalView& force, const NodalView& total, const NodalView& passing) {
  const Kokkos::View<char*> open = constraints.open;
  Kokkos::parallel_for(
      "pass on", Kokkos::RangePolicy<>(0, total.extent(0)), KOKKOS_LAMBDA(int i) {
        if (!open(i)) return;
        total(i) -= force(i);
        passing(i) += force(i);
      });
}

}  // namespace

StepSystem::StepSystem(const Space& space, StateStore& store, std::vector<Term*> terms, LinearSolver& solver,
                       std::function<BlockData(const StepView&)> block_data)
    : space_(space),
      store_(store),
      terms_(std::move(terms)),
      solver_(solver),
      block_data_(std::move(block_data)),
      assembler_(space.dofs()),
      convergence_(space, store),
      levels_(space),
      evaluated_(space.dofs()->owned()),
      balance_(space.dofs()->owned()) {
  int slots = 0;
  for (Term* term : terms_) {
    term->declare_state(store_);
    term->sparsity(assembler_);
    history_slot_.push_back(face<History>(*term) ? slots++ : -1);
  }
  history_ = faces<History>(terms_);
  store_.allocate_history(slots);
  assembler_.finalise();
  const int n = space.dofs()->num_overlap_dofs();
  for (NodalView* v : {&reaction_, &total_, &acting_, &whole_, &passing_, &outside_})
    *v = NodalView("sum of forces", n);
  constraints_ = Constraints(n);
  convergence_.declare_state();
  view_.constrained = constraints_.mask;
  view_.open = constraints_.open;
  view_.outside = outside_;
  view_.sensitivity.resize(space.num_fields());
  activate(terms_);
}

void StepSystem::activate(const std::vector<Term*>& active) {
  active_ = active;
  unilateral_ = faces<Unilateral>(active_);
  foresees_ = faces<Foresees>(active_);
  reports_ = faces<Reports>(active_);
  force_.clear();
  for (std::size_t k = 0; k < active_.size(); ++k) force_.emplace_back("term force", total_.extent(0));
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

void StepSystem::prepare_view(const StepRequest& request, StepView::Kind kind) {
  store_.begin();
  evaluated_at_x_ = false;
  scheme_ = request.scheme;
  const State& old = store_.committed();
  State& trial = store_.trial();
  const double passing = kind == StepView::Kind::step ? request.dt : 0.0;
  trial.time = old.time + passing;
  view_.kind = kind;
  view_.time_old = old.time;
  view_.time_end = trial.time;
  view_.dt = request.dt;
  view_.increment = old.increment;
  view_.value_old = old.value;
  view_.value_end = trial.value;
  const double conjugate = 1 + (scheme_.lead() * scheme_.gamma - scheme_.bend()) / scheme_.beta;
  view_.impact = {{}, {}, conjugate, scheme_.damping(), scheme_.lead() * request.dt};
  view_.x_old = old.coordinates;
  view_.x_end = trial.coordinates;
  const double momentum = view_.end_weight = 1 - scheme_.alpha_f;
  // A balance over the whole step sees the midpoint geometry, on which div(Delta u) is the volume change to second
  // order.
  const double balance = scheme_.incremental ? 0.5 : momentum;
  const double balance_time = scheme_.incremental ? scheme_.theta : momentum;
  view_.momentum = {old.time + momentum * passing, {}, momentum};
  view_.balance = {old.time + balance_time * passing, {}, balance};
  levels_.show(view_);
  view_.inertia = scheme_.inertia;
  view_.flow = scheme_.flow;
  view_.linearisation = 0;
  view_.elastic_share = 0;
  view_.committed = &old;
  view_.trial = &trial;
  set_sensitivities();
}

void StepSystem::set_sensitivities() {
  const double dt = view_.dt, af = scheme_.alpha_f;
  for (int f = 0; f < space_.num_fields(); ++f) {
    Sensitivity& s = view_.sensitivity[f];
    if (space_.field(f).time_order == 2) {
      s.value = 1 - af;
      s.velocity = scheme_.inertia ? (1 - af) * scheme_.gamma / (scheme_.beta * dt) : 1 / dt;
      s.rate = scheme_.incremental ? 1 / dt : s.velocity;
      s.acceleration = scheme_.inertia ? (1 - scheme_.alpha_m) / (scheme_.beta * dt * dt) : 0.0;
    } else {
      s.value = scheme_.incremental ? scheme_.theta : scheme_.flow_alpha_f;
      s.rate = scheme_.incremental ? 1 / dt : scheme_.flow_alpha_m / (scheme_.theta * dt);
      s.velocity = s.rate;
      s.acceleration = 0;
    }
  }
}

void StepSystem::levels(const Vector& x) {
  const State& old = store_.committed();
  const State& trial = store_.trial();
  import_owned(*space_.dofs(), x, trial.value);
  levels_.of_step(scheme_, view_, old, trial);
  if (view_.kind == StepView::Kind::step) levels_.given_rates(constraints_, scheme_, view_.dt, old, trial);
}

void StepSystem::constrain(const StepRequest& request) {
  Kokkos::deep_copy(constraints_.mask, char(0));
  Kokkos::deep_copy(constraints_.moves, char(0));
  Kokkos::deep_copy(constraints_.open, char(0));
  Kokkos::deep_copy(constraints_.value, store_.committed().value);
  request.prescribe(view_.time_old, view_.time_end, store_.committed(), constraints_);
  if (!scheme_.flow)  // geostatic: fields of first order stay as they are
    for (int f = 0; f < space_.num_fields(); ++f)
      if (space_.field(f).time_order == 1)
        for (const auto& [begin, end] : overlap_ranges(*space_.dofs(), f))
          hold(constraints_, store_.committed().value, begin, end);
  find_outside(request);
}

void StepSystem::find_outside(const StepRequest& request) {
  int open = 0;
  for (std::size_t i = 0; i < outside_.extent(0); ++i) {
    if (constraints_.mask(i)) constraints_.open(i) = 0;
    open += constraints_.open(i);
    outside_(i) = constraints_.value(i);
  }
  const double weight = scheme_.incremental ? scheme_.theta : scheme_.flow_alpha_f;  // of the end at the balance level
  if (weight == 1 || sum_over_ranks(*space_.dofs()->comm(), open) == 0) return;
  Constraints before(static_cast<int>(total_.extent(0)));
  request.prescribe(view_.time_old, view_.time_old, store_.committed(), before);
  for (std::size_t i = 0; i < outside_.extent(0); ++i)
    if (constraints_.open(i) && before.open(i)) outside_(i) += (1 - weight) * (before.value(i) - constraints_.value(i));
}

int StepSystem::history_slot(int k) const {
  return history_slot_[std::find(terms_.begin(), terms_.end(), active_[k]) - terms_.begin()];
}

int StepSystem::evaluate_term(Term& term, const NodalView& force, const ResidualView& to) {
  std::string problem;
  int failed = 0;
  const OpenDescriptors before;
  try {
    failed = term.residual(view_, to);
    check_foreign_code(&before);  // before the ranks wait for each other, by files that may be gone
    if (failed == 0 && !finite(force)) problem = ", which gives a force or flux that is not finite";
  } catch (...) {
    problem = ", which throws: " + fault_thrown();
  }
  if (!problem.empty()) failed = 1;
  if (failed > 0 && failure_.empty()) failure_ = term.name() + problem;
  return failed;
}

int StepSystem::evaluate_terms() {
  for (const NodalView& sizes : {total_, acting_, whole_, passing_}) Kokkos::deep_copy(sizes, 0.0);
  int failures = 0;
  failure_.clear();
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const NodalView force = force_[k];
    Kokkos::deep_copy(force, 0.0);
    const ResidualView to(force, acting_, whole_, passing_);
    failures += evaluate_term(*active_[k], force, to);
    const int slot = history_slot(static_cast<int>(k));
    if (slot >= 0) {
      const NodalView now = store_.trial().history_forces[slot], old = store_.committed().history_forces[slot];
      Kokkos::deep_copy(now, force);
      KokkosBlas::update(view_.end_weight, now, scheme_.alpha_f, old, 0.0, force);
      history_[slot]->correction(view_, to);
    }
    KokkosBlas::axpy(1.0, force, total_);
    if (exchanges(*active_[k])) pass_on(constraints_, force, total_, passing_);
  }
  return failures;
}

bool StepSystem::complete() {
  int failures = 0;
  for (std::size_t k = 0; k < active_.size(); ++k)
    if (auto* const term = face<Completes>(*active_[k]))
      failures += term->complete(view_, store_.trial().history_forces[history_slot(static_cast<int>(k))]);
  failures = sum_over_ranks(*space_.dofs()->comm(), failures);
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
  levels(x);
  for (Foresees* term : foresees_) term->foresee_jacobian(jacobian_follows);
  const int failures = sum_over_ranks(*space_.dofs()->comm(), evaluate_terms());
  for (Foresees* term : foresees_) term->foresee_jacobian(false);
  if (failures > 0) {
    failure_ = std::to_string(failures) + (failures == 1 ? " point" : " points") + " failed in " +
               broadcast(*space_.dofs()->comm(), failure_);
    return false;
  }
  split_reactions(constraints_, passing_, total_, reaction_);
  export_overlap(*space_.dofs(), total_, f);
  convergence_.measure(acting_, whole_);
  Tpetra::deep_copy(evaluated_, x);
  Tpetra::deep_copy(balance_, f);
  evaluated_at_x_ = true;
  return true;
}

bool StepSystem::add_matrices() {
  assembler_.begin(constraints_.mask);
  std::string problem;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    try {
      assembler_.leave_out(exchanges(*active_[k]) ? view_.open : Kokkos::View<const char*>());
      active_[k]->jacobian(view_, assembler_, history_slot(static_cast<int>(k)) >= 0 ? view_.end_weight : 1.0);
    } catch (...) {
      if (problem.empty()) problem = "the Jacobian of " + active_[k]->name() + ": " + fault_thrown();
    }
  }
  assembler_.end();
  ++view_.linearisation;
  problem = broadcast(*space_.dofs()->comm(), problem);
  if (!problem.empty()) failure_ = problem;
  return problem.empty();
}

void StepSystem::check_chord() {
  const TimeScheme& t = scheme_;
  std::vector<double> key{view_.dt, t.inertia ? 1.0 : 0.0,     t.flow ? 1.0 : 0.0, t.alpha_m,      t.alpha_f, t.beta,
                          t.gamma,  t.incremental ? 1.0 : 0.0, t.flow_alpha_m,     t.flow_alpha_f, t.theta};
  key.insert(key.end(), constraints_.mask.data(), constraints_.mask.data() + constraints_.mask.extent(0));
  key.insert(key.end(), constraints_.open.data(), constraints_.open.data() + constraints_.open.extent(0));
  if (sum_over_ranks(*space_.dofs()->comm(), chord_.belongs_to(key) ? 0 : 1) > 0) chord_.forget();
  chord_.start_step(key);
}

bool StepSystem::jacobian(const Vector& x) {
  if (chord_.may_reuse() && solver_.exact()) return true;
  {
    const Stopwatch watch(times_.jacobian);
    if (!is_evaluated_at(x))
      for (Foresees* term : foresees_) term->forget_foreseen();
    evaluated_at_x_ = false;
    levels(x);
    if (!add_matrices()) return false;
    chord_.refreshed();
    convergence_.measure_rounding(*assembler_.matrix(), x);
  }
  solver_.set_matrix(assembler_.matrix(), [this] { return block_data_(view_); });
  return true;
}

void StepSystem::apply_jacobian(const Vector& v, Vector& jv) { assembler_.matrix()->apply(v, jv); }

bool StepSystem::solve(const Vector& f, Vector& dx) {
  const Stopwatch watch(times_.linear);
  const LinearReport report = solver_.solve(f, dx, {convergence_.linear_tolerance(), enough_});
  enough_.clear();
  linear_iterations_ += report.iterations;
  factorisations_ += report.factored ? 1 : 0;
  if (!report.converged) failure_ = "linear solver: " + report.reason;
  return report.converged;
}

void StepSystem::observe(double worst) {
  chord_.observe(worst, convergence_.observe());
  view_.elastic_share = elastic_share_.next(worst);
  // by field, so that no field is solved further than the worst one needs
  const double share = solver_.iterative() ? forcing_.next(worst) : 0.0;
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
  prepare_view(request, StepView::Kind::step);
  constrain(request);
  check_chord();
  forcing_.start_step();
  elastic_share_.start();
  enough_.clear();
  Vector x(map());
  start_from(constraints_, store_.committed().value, x);
  levels(x);
  for (Term* term : active_) term->begin(view_);
  return x;
}

bool StepSystem::is_evaluated_at(const Vector& x) const {
  return sum_over_ranks(*space_.dofs()->comm(), evaluated_at_x_ && equal(evaluated_, x) ? 0 : 1) == 0;
}

std::string StepSystem::hints() const {
  std::string all;
  for (const Reports* term : reports_)
    if (const std::string hint = term->hint(view_); !hint.empty()) all += "; " + hint;
  return all;
}

double StepSystem::step_limit(double dt) const {
  for (const Unilateral* term : unilateral_) dt = std::min(dt, term->step_limit(store_.committed(), dt));
  return dt;
}

bool StepSystem::refresh_history() {
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

NodalView StepSystem::static_residual() {
  prepare_view(standing_still(false), StepView::Kind::rest);
  levels(owned_part(*space_.dofs(), store_.committed().value));
  for (Term* term : active_) term->begin(view_);
  evaluate_terms();
  return sum_overlap(*space_.dofs(), total_);
}

void StepSystem::restore_solver(const std::vector<double>& memory) {
  const int any = memory.empty() ? 0 : 1;
  if (sum_over_ranks(*space_.dofs()->comm(), any) == 0) return;
  std::vector<double> solver = memory;
  chord_.restore(solver);
  solver_.restore(rcp(new CrsMatrix(*assembler_.matrix(), Teuchos::Copy)), solver);
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

void StepSystem::levels_at_rest() {
  levels_.at_rest(store_.committed(), store_.trial());
  for (int f = 0; f < space_.num_fields(); ++f) {
    const bool second = space_.field(f).time_order == 2;
    view_.sensitivity[f] = {0, second ? 0.0 : 1.0, 0, second ? 1.0 : 0.0};
  }
  view_.momentum.geometry_weight = view_.balance.geometry_weight = 0;
}

bool StepSystem::begin_rates(const StepRequest& request) {
  prepare_view(standing_still(true), StepView::Kind::initial_rates);
  chord_.forget();
  constrain(request);
  levels_at_rest();
  for (Term* term : active_) term->begin(view_);
  return sum_over_ranks(*space_.dofs()->comm(), evaluate_terms()) == 0;
}

const CrsMatrix& StepSystem::rate_matrix() {
  assembler_.begin(constraints_.mask);
  for (int k = 0; k < static_cast<int>(active_.size()); ++k)
    if (history_slot(k) < 0) active_[k]->jacobian(view_, assembler_, 1.0);
  assembler_.end();
  return *assembler_.matrix();
}

bool StepSystem::solve_rates(double tolerance, Vector& rates) {
  for (std::size_t i = 0; i < total_.extent(0); ++i) total_(i) = constraints_.mask(i) ? 0.0 : -total_(i);
  Vector right(map());
  export_overlap(*space_.dofs(), total_, right);
  rates.putScalar(0);
  if (right.norm2() == 0) return true;
  solver_.reset();
  solver_.set_matrix(assembler_.matrix(), [this] { return block_data_(view_); });
  const bool solved = solver_.solve(right, rates, tolerance).converged;
  solver_.reset();
  return solved;
}

}  // namespace mudline
