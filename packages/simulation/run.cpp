#include "simulation/run.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include "ale/yield_drift.hpp"
#include "core/foreign_library.hpp"
#include "core/log.hpp"
#include "core/stopwatch.hpp"
#include "core/told.hpp"
#include "integrator/overlap.hpp"
#include "integrator/time_error.hpp"
#include "simulation/filter_output.hpp"
#include "simulation/initial_rates.hpp"
#include "simulation/mesh_watch.hpp"
#include "simulation/progress_log.hpp"
#include "simulation/results/excess.hpp"
#include "simulation/results/resistance.hpp"
#include "simulation/results/results.hpp"
#include "simulation/results/safety.hpp"
#include "simulation/run_start.hpp"
#include "simulation/step_report.hpp"
#include "simulation/wall_dissipation.hpp"

namespace mudline {

namespace {

volatile std::sig_atomic_t stop_signal = 0;

void on_signal(int signal) {
  if (stop_signal && signal != SIGUSR1 && signal != SIGHUP) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  stop_signal = signal;
}

/// Whether the trial state turns elements inside out that were not before.
bool folds_elements(const Model& model) {
  const Ale& ale = *model.ale();
  return !(ale.quality(model.store().trial()) > 0) && ale.quality(model.store().committed()) > 0;
}

}  // namespace

void catch_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGUSR1, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // as under nohup
}

Run::Run(std::unique_ptr<Model> model, ModelMaker make_model, const OutputSettings& settings, const Origin& origin,
         const RunOptions& options, Observers watchers)
    : make_model_(std::move(make_model)),
      settings_(settings),
      origin_(origin),
      options_(options),
      checkpoint_(stem_ + ".restart", Checkpoint::For::restart, origin_, options.accept_changes) {
  make_observers(std::move(watchers));
  take_model(std::move(model));
  std::filesystem::create_directories(settings_.folder);
  lock_ = std::make_unique<ResultLock>(model_->mesh().comm(), settings_.stem());
  if (options_.restart && !has_results(*model_->mesh().comm(), stem_)) {
    log::info("there are no results " + stem_ + " to continue yet: the run starts");
    options_.restart = false;
  }
  if (options_.restart) {
    go_on_from(checkpoint_);
    checkpoint_.resume(model_->store().committed().time, *history_, *fields_);
    return;
  }
  if (options_.start.empty()) {
    if (options_.reference_pressure.extent(0) > 0) pressure_->keep_reference(options_.reference_pressure);
    take_start();
  } else {
    Checkpoint start(options_.start, Checkpoint::For::start, origin_, false);
    go_on_from(start);
  }
  make_room(model_->mesh().comm(), settings_.stem(), origin_, options_.overwrite);
}

void Run::go_on_from(Checkpoint& checkpoint) {
  if (const auto remeshed = checkpoint.open(model_->mesh())) take_model(make_model_(remeshed));
  checkpoint.read(*model_, *pressure_, progress_);
}

void Run::make_observers(Observers watchers) {
  const auto add = [this](auto observer) {
    auto* const added = observer.get();
    observers_.push_back(std::move(observer));
    return added;
  };
  if (settings_.error_estimate) error_estimate_ = add(std::make_unique<ErrorOutput>(settings_.target_error));
  add(std::make_unique<MeshWatch>());
  for (auto& watcher : watchers) add(std::move(watcher));
  add(std::make_unique<WallDissipation>());
  add(std::make_unique<FilterOutput>(settings_.filters));
  add(std::make_unique<SafetyResults>(progress_.results));
  // these come after all that have columns and fields
  history_ = add(std::make_unique<HistoryOutput>(settings_, observers_, error_estimate_));
  ends_ = std::make_unique<StageEnds>(*history_);
  add(std::make_unique<ResistanceResults>());
  add(std::make_unique<ExcessResults>());
  fields_ = add(std::make_unique<FieldOutput>(settings_, origin_, observers_));
  add(std::make_unique<ProgressLog>());
  add(std::make_unique<Results>(progress_.results, observers_, *history_));
}

void Run::take_model(std::unique_ptr<Model> model) {
  model_ = std::move(model);
  balances_ = std::make_unique<Balances>(*model_);
  pressure_ = std::make_unique<ExcessPressure>(*model_);
  tell([this](Observer& observer) { observer.declare_state(*model_); });
  if (const Ale* const ale = model_->ale())
    if (const std::string problem = ale->problem(model_->store()); !problem.empty())
      throw InputError("mesh motion: " + problem);
}

RunView Run::view(bool resumed) const {
  const State& state = model_->store().committed();
  const bool at_end = progress_.stage_over || state.time >= (progress_.stage_start + stage().duration) * (1 - 1e-12);
  return {*model_,        state,
          stage(),        resumed,
          at_end,         progress_.stage_start,
          progress_.step, progress_.last_dt,
          rejected_,      mesh_time_,
          solve_,         report_,
          *balances_,     *pressure_,
          stem_,          lost_factor_};
}

void Run::tell(const std::function<void(Observer&)>& action) {
  for (const auto& observer : observers_) call(*observer, *model_, action);
}

void Run::tell(void (Observer::*event)(const RunView&), bool resumed) {
  const RunView now = view(resumed);
  tell([&](Observer& observer) { (observer.*event)(now); });
}

void Run::tell_step(const StepReport& solve) {
  solve_ = solve;
  const RunView now = view();
  tell([&](Observer& observer) { observer.report(now, report_); });
  if (const std::string why = ends_->reached(now, progress_.ends); !why.empty()) {
    progress_.stage_over = true;
    log::info("  stage '" + now.stage.name + "' ends at t " + told(now.state.time, "%.6g s") + ", " + why);
  }
  tell(&Observer::step);
}

bool Run::observers_object() {
  std::string reason;
  const RunView now = view();
  tell([&](Observer& observer) {
    const std::string why = observer.objection(now);
    if (reason.empty() && !why.empty())
      reason = observer.name.empty() ? why : "observer '" + observer.name + "': " + why;
  });
  if (!reason.empty()) log::error(reason);
  return !reason.empty();
}

void Run::count_increment(int taken) {
  model_->store().committed().increment = {progress_.stage + 1, progress_.step_in_stage + taken + 1,
                                           progress_.stage_start};
}

StepRequest Run::request(const Stage& stage, double dt) const {
  StepRequest request;
  request.dt = dt;
  request.scheme = stage.scheme(progress_.step_in_stage);
  request.prescribe = [this, &stage](double t_old, double t_end, const State& committed, Constraints& to) {
    model_->prescribe(stage, t_old, t_end, committed, to);
  };
  return request;
}

bool Run::stop_requested() const {
  const int here = stop_signal ? 1 : 0;
  return sum_over_ranks(*model_->mesh().comm(), here) > 0;
}

bool Run::begin_stage(const Stage& stage) {
  const bool fresh = !progress_.stage_open;
  model_->activate(stage, fresh);
  if (!fresh) {
    count_increment(0);
    checkpoint_.restore_solver(model_->system());
    report_ = report_of_contacts(*model_);
    tell(&Observer::begin_stage, true);
    return true;
  }
  log::info("stage '" + stage.name + "'");
  progress_.stage_open = true;
  progress_.stage_over = false;
  lost_factor_ = 0;
  progress_.step_in_stage = 0;
  progress_.stage_start = model_->store().committed().time;
  progress_.next_dt = stage.control.initial;
  count_increment(0);
  progress_.last_dt = 0;
  model_->system().convergence().begin_stage();
  if (!model_->system().refresh_history()) {
    log::error("the stresses of the start of stage '" + stage.name + "' cannot be evaluated" +
               model_->system().hints());
    return false;
  }
  const Stage* const before = progress_.stage > 0 ? model_->stages()[progress_.stage - 1].get() : nullptr;
  InitialRates(*model_, stage, before).give(request(stage, stage.control.initial));
  balances_->jump([&] { model_->start_bodies(stage); });
  report_ = report_of_contacts(*model_);
  ends_->begin_stage(view(), progress_.ends);
  tell(&Observer::begin_stage);
  return true;
}

bool Run::run_geostatic(const Stage& stage) {
  // Equilibrium takes no time: loads and prescribed values are those of this instant. The step length of 1 s only keeps
  // the rates' coefficients finite; the rates themselves are off.
  StepRequest now = request(stage, 1.0);
  now.prescribe = [this, &stage](double, double t_end, const State& committed, Constraints& to) {
    model_->prescribe(stage, t_end, t_end, committed, to);
  };
  const double time = model_->store().committed().time;
  model_->store().committed().time = time - now.dt;
  // a balance that is checked is always solved for: the displacement shows an imbalance that the residual's tolerance
  // would hide
  NewtonOptions newton = model_->newton();
  newton.least_iterations = stage.balance_tolerance > 0 ? 1 : 0;
  const StepReport report = Stepper(model_->system()).attempt(now, model_->tolerances(), newton);
  check_foreign_code();
  model_->store().committed().time = time;
  if (!report.converged) {
    log::error("geostatic equilibrium of stage '" + stage.name + "' not found: " + report.reason);
    return false;
  }
  const double largest = largest_displacement();
  log::info("  balanced in " + std::to_string(report.newton_iterations) + " iterations, largest displacement " +
            told(largest, "%.3g m"));
  if (stage.balance_tolerance > 0 && largest > stage.balance_tolerance) {
    log::error("stages/" + stage.name + "/balance tolerance: equilibrium needs displacements of " +
               told(largest, "%.3g m") + ", more than the allowed " + told(stage.balance_tolerance, "%.3g m") +
               "; check loads, supports and the initial stresses against each other");
    return false;
  }
  balances_->add_step();
  model_->store().trial().time = model_->store().committed().time;
  Kokkos::deep_copy(model_->store().trial().rate, 0.0);
  Kokkos::deep_copy(model_->store().trial().acceleration, 0.0);
  model_->store().accept();
  report_ = report_of_step(*model_);
  ++progress_.step;
  reset_displacements();
  take_start();
  tell_step(report);
  return true;
}

void Run::take_start() {
  balances_->start();
  pressure_->take_start();
  tell(&Observer::take_start);
}

double Run::largest_displacement() const {
  const int u = model_->space().find("displacement");
  double largest = 0;
  if (u >= 0)
    for (const auto& [begin, end] : overlap_ranges(*model_->space().dofs(), u))
      for (int i = begin; i < end; ++i)
        largest = std::max(largest, std::abs(model_->store().trial().value(i) - model_->store().committed().value(i)));
  return max_over_ranks(*model_->mesh().comm(), largest);
}

void Run::reset_displacements() {
  const int u = model_->space().find("displacement");
  if (u < 0) return;
  State& state = model_->store().committed();
  for (const auto& [begin, end] : overlap_ranges(*model_->space().dofs(), u))
    for (int i = begin; i < end; ++i) state.value(i) = 0;
}

double Run::choose_dt(const Stage& stage) const {
  const double time = model_->store().committed().time, end = progress_.stage_start + stage.duration;
  const double dt = model_->system().terms().step_limit(std::min(progress_.next_dt, stage.control.maximum));
  const double left = end - time;
  if (dt > left * (1 - 1e-9)) return left;
  // two equal last steps instead of a full one and a sliver
  return dt > 0.5 * left && dt < left ? std::min(dt, 0.5 * left * (1 + 1e-12)) : dt;
}

LocalError Run::local_error(const Stage& stage) const {
  if (stage.control.error_tolerance <= 0) return {};
  StepSystem& system = model_->system();
  return TimeError(model_->space())
      .measure(system.view(), stage.scheme(progress_.step_in_stage), progress_.last_dt, progress_.step_in_stage,
               system.convergence().largest_norms(), stage.control.error_tolerance);
}

bool Run::take_step(const Stage& stage, double& dt, StepReport& report, ExitCode& exit) {
  for (;;) {
    if (moves_mesh(stage)) model_->store().keep();
    const OpenDescriptors before;
    report = Stepper(model_->system()).attempt(request(stage, dt), model_->tolerances(), model_->newton());
    check_foreign_code(&before);
    double next = -1;
    if (report.converged) {
      error_ = local_error(stage);
      next = stage.control.after_error(dt, error_);
      if (next < 0 && accept(stage, report)) return true;
      if (next > 0) report.reason = "time error " + told(error_.ratio, "%.2g") + " times its tolerance";
    }
    ++rejected_;
    if (next < 0) next = stage.control.after_failure(dt);
    const double time = model_->store().committed().time;
    if (next < 0 && stage.strength_reduction.acts()) {
      end_reduction(stage, dt, report.reason);
      return false;
    }
    if (next < 0 || stop_requested()) {
      exit = next < 0 ? ExitCode::no_convergence : ExitCode::stopped;
      if (next < 0)
        log::error("step " + std::to_string(progress_.step + 1) + ", t = " + told(time, "%.6g s") + ": " +
                   report.reason + "; the step cannot be cut below " + told(stage.control.minimum, "%.3g s"));
      return false;
    }
    log::info("  step " + std::to_string(progress_.step + 1) + " rejected: " + report.reason + "; dt " +
              told(dt, "%.3g") + " -> " + told(next, "%.3g s"));
    dt = progress_.next_dt = next;
  }
}

std::string Run::flows(const Stage& stage) const {
  const StrengthReduction& reduction = stage.strength_reduction;
  if (!reduction.acts()) return "";
  const double growth =
      reduction.rate(stage.duration) * (model_->store().trial().time - model_->store().committed().time);
  const double moved = largest_displacement(), limit = reduction.displacement_limit * growth * model_->soil()->extent();
  if (moved <= limit) return "";
  return "the soil moves by " + told(moved, "%.3g m") + " while the strength factor grows by " + told(growth, "%.3g") +
         ", more than " + told(limit, "%.3g m");
}

void Run::end_reduction(const Stage& stage, double dt, const std::string& reason) {
  const double since = model_->store().committed().time - progress_.stage_start;
  const double found = model_->soil()->strength_factor(since);
  lost_factor_ = model_->soil()->strength_factor(since + dt);
  progress_.stage_over = true;
  log::info("  stage '" + stage.name + "' ends: no equilibrium with the strengths over " + told(lost_factor_, "%.6g") +
            " (" + reason + "); factor of safety " + told(found, "%.6g"));
}

bool Run::accept(const Stage& stage, StepReport& solve) {
  if (const std::string why = flows(stage); !why.empty()) {
    solve.reason = why;
    solve.converged = false;
    return false;
  }
  if (moves_mesh(stage) && !stage.allow_folded && folds_elements(*model_)) {
    solve.reason = "the step folds elements";
    solve.converged = false;
    return false;
  }
  balances_->add_step();
  model_->store().accept();
  count_increment(1);
  Report report = report_of_step(*model_);
  const bool moves = moves_mesh(stage) && model_->ale()->due(progress_.step + 1, model_->store().committed());
  const std::string veto = moves ? relocate_mesh() : "";
  if (!veto.empty()) {
    solve.reason = veto;
    model_->store().restore();
    solve.converged = false;
    return false;
  }
  report_ = std::move(report);
  return true;
}

bool Run::moves_mesh(const Stage& stage) const { return model_->ale() && stage.mesh_motion; }

std::string Run::relocate_mesh() {
  const Stopwatch watch(mesh_time_);
  StateStore& store = model_->store();
  const std::vector<double> conserved = balances_->conserved();
  MeshReceipt receipt = model_->ale()->relocate(store, model_->system().constraints());
  if (!receipt.moved) return receipt.veto;
  if (!model_->system().refresh_history()) return "the remapped state cannot be evaluated" + model_->system().hints();
  receipt.yield_drift = yield_drift(*model_->soil(), store.committed(), store.trial());
  store.take_evaluated();
  balances_->add_remap(receipt);
  balances_->add_remap_of_conserved(conserved);
  transfers_.tell(*model_, receipt, "    mesh moved: " + told(receipt.largest_motion, "Courant %.2f, "), log::detail);
  return "";
}

void Run::after_step(const Stage& stage, double dt, const StepReport& report) {
  ++progress_.step;
  ++progress_.step_in_stage;
  ++steps_here_;
  progress_.last_dt = dt;
  // a step that was shortened to meet the end of a stage or a contact's limit does not show how large a step Newton's
  // method can take
  const double next = stage.control.after_success(dt, report.hardest_solve, error_, report.retried);
  progress_.next_dt =
      dt < progress_.next_dt * (1 - 1e-9) && next >= dt ? std::max(next, std::min(progress_.next_dt, next * 2)) : next;
  tell_step(report);
  if (settings_.checkpoint_steps > 0 && progress_.step % settings_.checkpoint_steps == 0) save_checkpoint();
}

void Run::save_checkpoint() { checkpoint_.write(*model_, *pressure_, progress_, *history_, *fields_); }

void Run::keep_checkpoint() const {
  checkpoint_.keep_as(stage_checkpoint(stem_, stage().name), *model_->mesh().comm());
}

void Run::end(RunEnd how) {
  const RunView now = view();
  tell([&](Observer& observer) { observer.end_run(now, how); });
}

void Run::save_and_end(RunEnd how) {
  save_checkpoint();
  end(how);
}

ExitCode Run::run_stage() {
  const double end = progress_.stage_start + stage().duration * (1 - 1e-9);
  while (!progress_.stage_over && model_->store().committed().time < end) {
    if (options_.maximum_steps > 0 && steps_here_ >= options_.maximum_steps) {
      save_and_end(RunEnd::interrupted);
      log::info("stopped after " + std::to_string(steps_here_) + " steps; continue with --restart");
      return ExitCode::done;
    }
    if (remeshing_due()) remesh();
    const Stage& stage = this->stage();
    if (progress_.step_in_stage >= stage.control.maximum_steps) {
      log::error("stages/" + stage.name + "/time step/maximum steps: " + std::to_string(stage.control.maximum_steps) +
                 " steps were taken and the stage is not over");
      save_and_end(RunEnd::interrupted);
      return ExitCode::no_convergence;
    }
    double dt = choose_dt(stage);
    StepReport report;
    ExitCode exit = ExitCode::done;
    if (!take_step(stage, dt, report, exit)) {
      if (progress_.stage_over) break;
      save_and_end(RunEnd::failed);
      return exit;
    }
    after_step(stage, dt, report);
    if (observers_object()) {
      save_and_end(RunEnd::failed);
      return ExitCode::no_convergence;
    }
    if (stop_requested()) {
      save_and_end(RunEnd::interrupted);
      log::warn("stopped by a signal after step " + std::to_string(progress_.step) + "; continue with --restart");
      return ExitCode::stopped;
    }
  }
  return ExitCode::done;
}

ExitCode Run::execute() {
  tell(&Observer::begin_run, options_.restart);
  const int stages = static_cast<int>(model_->stages().size());
  // where the run goes on between two stages the terms of the stage before are active already and do not start anew
  if (!progress_.stage_open && progress_.stage > 0) {
    model_->store().committed().increment.stage_start = progress_.stage_start;
    model_->activate(*model_->stages()[progress_.stage - 1], false);
  }
  for (; progress_.stage < stages; ++progress_.stage) {
    const Stage& stage = this->stage();
    if (!begin_stage(stage)) {
      end(RunEnd::interrupted);
      return ExitCode::no_convergence;
    }
    if (stage.type == Stage::Type::geostatic) {
      if (!run_geostatic(stage)) {
        save_and_end(RunEnd::interrupted);
        return ExitCode::no_convergence;
      }
      tell(&Observer::end_stage);
    } else {
      const double duration = stage.duration;
      const ExitCode exit = run_stage();  // remeshing replaces the stages by others of the same names
      const bool complete =
          progress_.stage_over || model_->store().committed().time >= progress_.stage_start + duration * (1 - 2e-9);
      if (exit != ExitCode::done || !complete) return exit;
      if (!progress_.stage_over && this->stage().strength_reduction.acts())
        log::warn("stage '" + this->stage().name +
                  "' ends in equilibrium: the factor of safety is above the largest factor, " +
                  told(this->stage().strength_reduction.largest, "%.6g"));
      if (!progress_.stage_over && !this->stage().ends.empty())
        log::warn("stage '" + this->stage().name + "' ends with its duration of " + told(duration, "%.6g s") +
                  ": nothing of its 'ends when' was reached");
      tell(&Observer::end_stage);
      if (this->stage().reset_displacements) reset_displacements();
    }
    const bool last = progress_.stage + 1 == stages;
    // the checkpoint of the last stage is written below with the stage open, so that a restart may prolong it
    if (last) break;
    progress_.stage_open = false;
    ++progress_.stage;
    save_checkpoint();
    --progress_.stage;
    keep_checkpoint();
  }
  check_foreign_code();
  save_checkpoint();
  keep_checkpoint();
  end(RunEnd::done);
  return ExitCode::done;
}

}  // namespace mudline
