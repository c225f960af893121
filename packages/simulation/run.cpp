#include "simulation/run.hpp"

#include <Teuchos_Time.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include "ale/yield_drift.hpp"
#include "core/log.hpp"
#include "integrator/overlap.hpp"

namespace mudline {

namespace {

volatile std::sig_atomic_t stop_signal = 0;

void on_signal(int signal) {
  if (stop_signal) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  stop_signal = signal;
}

std::string format(const char* pattern, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, pattern, value);
  return buffer;
}

}  // namespace

void catch_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

Run::Run(Model& model, const OutputSettings& settings, const std::string& deck_text, const RunOptions& options)
    : model_(model), settings_(settings), options_(options), balances_(model) {
  std::filesystem::create_directories(settings_.folder);
  if (options_.restart) {
    load_checkpoint();
    results_ = std::make_unique<Results>(model_, settings_, deck_text, model_.store().committed().time);
    restore_initial_pressure();
    return;
  }
  results_ = std::make_unique<Results>(model_, settings_, deck_text, std::nullopt);
  results_->take_initial_pressure();
  balances_.start();
}

StepRequest Run::request(const Stage& stage, double dt) const {
  StepRequest request;
  request.dt = dt;
  request.scheme = stage.scheme(progress_.step_in_stage);
  request.prescribe = [this, &stage](double t_old, double t_end, const State& committed, Constraints& to) {
    model_.prescribe(stage, t_old, t_end, committed, to);
  };
  return request;
}

bool Run::stop_requested() const {
  const int here = stop_signal ? 1 : 0;
  return sum_over_ranks(*model_.mesh().comm(), here) > 0;
}

bool Run::begin_stage(const Stage& stage) {
  const bool fresh = !progress_.stage_open;
  model_.activate(stage, fresh);
  if (!fresh) {
    restore_solver();
    return true;
  }
  log::info("stage '" + stage.name + "'");
  progress_.stage_open = true;
  progress_.step_in_stage = 0;
  progress_.stage_start = model_.store().committed().time;
  progress_.next_dt = stage.control.initial;
  progress_.next_field_time = progress_.stage_start + settings_.field_interval;
  std::fill(model_.stepper().reference_floor().begin(), model_.stepper().reference_floor().end(), 0.0);
  if (!model_.stepper().refresh_history()) {
    log::warn("the stresses of the start of stage '" + stage.name + "' cannot be evaluated");
    return false;
  }
  State& state = model_.store().committed();
  if (stage.initial_rates != Stage::InitialRates::keep) {
    Kokkos::deep_copy(state.acceleration, 0.0);
    if (stage.initial_rates == Stage::InitialRates::zero) Kokkos::deep_copy(state.rate, 0.0);
  }
  if (stage.type == Stage::Type::dynamic && stage.initial_rates == Stage::InitialRates::consistent &&
      !model_.stepper().initialise_rates(request(stage, stage.control.initial), model_.tolerances().linear)) {
    log::warn("initial accelerations cannot be computed; stage '" + stage.name + "' starts from zero ones");
    Kokkos::deep_copy(state.acceleration, 0.0);
  }
  balances_.jump([&] { model_.start_bodies(stage); });
  return true;
}

bool Run::run_geostatic(const Stage& stage) {
  // Equilibrium takes no time: loads and prescribed values are those of this instant. The step length of 1 s only keeps
  // the rates' coefficients finite; the rates themselves are off.
  StepRequest now = request(stage, 1.0);
  now.prescribe = [this, &stage](double, double t_end, const State& committed, Constraints& to) {
    model_.prescribe(stage, t_end, t_end, committed, to);
  };
  const double time = model_.store().committed().time;
  model_.store().committed().time = time - now.dt;
  const StepReport report = model_.stepper().attempt(now, model_.tolerances(), model_.newton());
  model_.store().committed().time = time;
  if (!report.converged) {
    log::warn("geostatic equilibrium of stage '" + stage.name + "' not found: " + report.reason);
    return false;
  }
  const int u = model_.space().find("displacement");
  double largest = 0;
  if (u >= 0)
    for (const auto& [begin, end] : overlap_ranges(*model_.space().dofs(), u))
      for (int i = begin; i < end; ++i)
        largest = std::max(largest, std::abs(model_.store().trial().value(i) - model_.store().committed().value(i)));
  largest = max_over_ranks(*model_.mesh().comm(), largest);
  log::info("  balanced in " + std::to_string(report.newton_iterations) + " iterations, largest displacement " + format("%.3g m", largest));
  if (stage.balance_tolerance > 0 && largest > stage.balance_tolerance) {
    log::warn("stages/" + stage.name + "/balance tolerance: equilibrium needs displacements of " + format("%.3g m", largest) +
              ", more than the allowed " + format("%.3g m", stage.balance_tolerance) +
              "; check loads, supports and the initial stresses against each other");
    return false;
  }
  balances_.add_step();
  model_.store().trial().time = model_.store().committed().time;
  Kokkos::deep_copy(model_.store().trial().rate, 0.0);
  Kokkos::deep_copy(model_.store().trial().acceleration, 0.0);
  model_.store().accept();
  const auto histories = term_histories();
  ++progress_.step;
  reset_displacements();
  balances_.start();
  results_->take_initial_pressure();
  results_->write_history(balances_, histories, 0.0, report.newton_iterations);
  return true;
}

void Run::reset_displacements() {
  const int u = model_.space().find("displacement");
  if (u < 0) return;
  State& state = model_.store().committed();
  for (const auto& [begin, end] : overlap_ranges(*model_.space().dofs(), u))
    for (int i = begin; i < end; ++i) state.value(i) = 0;
}

double Run::choose_dt(const Stage& stage) const {
  const double time = model_.store().committed().time, end = progress_.stage_start + stage.duration;
  double dt = std::min(progress_.next_dt, stage.control.maximum);
  for (Term* term : model_.stepper().active()) dt = std::min(dt, term->step_limit(model_.store().committed(), dt));
  const double left = end - time;
  if (dt > left * (1 - 1e-9)) return left;
  // two equal last steps instead of a full one and a sliver
  return dt > 0.5 * left && dt < left ? std::min(dt, 0.5 * left * (1 + 1e-12)) : dt;
}

double Run::local_error(const Stage& stage) const {
  if (stage.control.error_tolerance <= 0) return 0;
  const State &old = model_.store().committed(), &now = model_.store().trial();
  const TimeScheme scheme = stage.scheme(progress_.step_in_stage);
  const double dt = model_.stepper().view().dt;
  double worst = 0;
  for (int f = 0; f < model_.space().num_fields(); ++f) {
    const bool second = model_.space().field(f).time_order == 2 && scheme.inertia;
    double error = 0, size = 0;
    for (int i = model_.space().dofs()->owned_begin(f); i < model_.space().dofs()->owned_end(f); ++i) {
      const double e = second ? dt * dt * std::abs(scheme.beta - 1.0 / 6) * std::abs(now.acceleration(i) - old.acceleration(i))
                              : 0.5 * dt * std::abs(now.rate(i) - old.rate(i));
      error += e * e;
      size += now.value(i) * now.value(i);
    }
    error = sum_over_ranks(*model_.mesh().comm(), error);
    size = sum_over_ranks(*model_.mesh().comm(), size);
    if (size > 0) worst = std::max(worst, std::sqrt(error / size));
  }
  return worst / stage.control.error_tolerance;
}

std::map<std::string, double> Run::term_histories() {
  std::map<std::string, double> values;
  const StepView& view = model_.stepper().view();
  for (const auto& [name, contact] : model_.contacts()) {
    std::map<std::string, double> own;
    contact->histories(view, own);
    const auto& active = model_.stepper().active();
    const bool acts = std::find(active.begin(), active.end(), contact.get()) != active.end();
    for (const auto& [key, value] : own) values[key] = acts || key.find("/work") != std::string::npos ? value : 0.0;
  }
  for (Term* term : model_.stepper().active())
    if (!dynamic_cast<Contact*>(term)) term->histories(view, values);
  std::map<std::string, double> shares;
  for (const auto& condition : model_.conditions()) condition->reactions(model_.stepper().reaction(), shares);
  const char* directions[] = {"driving force x [N]", "driving force y [N]", "driving moment [N m]"};
  for (const auto& [name, body] : model_.bodies()) {
    const BodyUnknowns& unknowns = body->unknowns();
    for (int k = 0; k < unknowns.count; ++k)
      shares["body/" + name + "/" + directions[unknowns.direction[k]]] = model_.stepper().reaction()(unknowns.dof[k]) / unknowns.scale[k];
  }
  for (const auto& [name, share] : shares) values[name] = sum_over_ranks(*model_.mesh().comm(), share);
  return values;
}

bool Run::take_step(const Stage& stage, double& dt, StepReport& report, ExitCode& exit) {
  for (;;) {
    if (moves_mesh(stage)) model_.store().keep();
    report = model_.stepper().attempt(request(stage, dt), model_.tolerances(), model_.newton());
    if (report.converged && accept(stage, report)) return true;
    ++rejected_;
    const double next = stage.control.after_failure(dt);
    const double time = model_.store().committed().time;
    if (next < 0 || stop_requested()) {
      exit = next < 0 ? ExitCode::no_convergence : ExitCode::stopped;
      if (next < 0)
        log::warn("step " + std::to_string(progress_.step + 1) + ", t = " + format("%.6g s", time) + ": " + report.reason +
                  "; the step cannot be cut below " + format("%.3g s", stage.control.minimum));
      return false;
    }
    log::info("  step " + std::to_string(progress_.step + 1) + " rejected: " + report.reason + "; dt " + format("%.3g", dt) + " -> " +
              format("%.3g s", next));
    dt = progress_.next_dt = next;
  }
}

void Run::log_step(const Stage& stage, double dt, const StepReport& report) const {
  const double time = model_.store().committed().time, done = time - progress_.stage_start;
  const double wall = Teuchos::Time::wallTime() - wall_start_;
  const double left = steps_here_ > 0 && done > 0 ? (stage.duration - done) / dt * wall / steps_here_ : 0;
  const std::string augmented = report.augmentations > 0 ? "  augmentations " + std::to_string(report.augmentations) : "";
  char line[200];
  std::snprintf(line, sizeof line, "  step %5d  t %.6g s  dt %.3g s  newton %d%s  linear %d%s  about %.0f s left", progress_.step, time, dt,
                report.newton_iterations, augmented.c_str(), report.linear_iterations, report.factorisations > 0 ? "" : " (reused)", left);
  log::info(line);
}

bool Run::accept(const Stage& stage, StepReport& report) {
  error_ = local_error(stage);
  balances_.add_step();
  model_.store().accept();
  histories_ = term_histories();
  if (!moves_mesh(stage) || !model_.ale()->due(progress_.step + 1, model_.store().committed())) return true;
  report.reason = relocate_mesh();
  if (report.reason.empty()) return true;
  model_.store().restore();
  report.converged = false;
  return false;
}

bool Run::moves_mesh(const Stage& stage) const { return model_.ale() && stage.mesh_motion; }

std::string Run::relocate_mesh() {
  StateStore& store = model_.store();
  MeshReceipt receipt = model_.ale()->relocate(store, model_.stepper().constraints());
  if (!receipt.moved) return receipt.veto;
  // the trial state still has the mesh as it was
  for (Term* term : model_.stepper().active()) term->relocate(store.trial().coordinates, store.committed());
  if (!model_.stepper().refresh_history()) return "the remapped state cannot be evaluated";
  receipt.yield_drift = yield_drift(*model_.soil(), store.committed(), store.trial());
  for (Term* term : model_.stepper().active()) term->adopt(store.trial(), store.committed());
  balances_.add_remap(receipt);
  warn_of_quality(receipt);
  char line[240];
  std::snprintf(line, sizeof line, "    mesh moved: quality %.2f -> %.2f, Courant %.2f, grains %+.1e, water %+.1e, restored %+.1e, yield drift %.1e", receipt.quality_before, receipt.quality,
                receipt.largest_motion, receipt.after.solid / receipt.before.solid - 1,
                receipt.before.water != 0 ? receipt.after.water / receipt.before.water - 1 : 0.0, receipt.restored_solid, receipt.yield_drift);
  log::detail(line);
  return "";
}

void Run::warn_of_quality(const MeshReceipt& receipt) {
  if (receipt.quality >= model_.ale()->accepted_quality() || poor_mesh_) return;
  poor_mesh_ = true;
  char line[240];
  std::snprintf(line, sizeof line,
                "the mesh's smallest scaled Jacobian is %.3g at t %.6g s, below 'mesh motion/lowest quality' = %.3g, and mesh motion cannot mend it: "
                "doubt the results from here on",
                receipt.quality, model_.store().committed().time, model_.ale()->accepted_quality());
  log::warn(line);
}

void Run::after_step(const Stage& stage, double dt, const StepReport& report) {
  const double error = error_;
  const auto& histories = histories_;
  ++progress_.step;
  ++progress_.step_in_stage;
  ++steps_here_;
  // the step that was shortened to meet the end of a stage or a contact's limit says nothing of the size Newton can take
  const double next = stage.control.after_success(dt, report.hardest_solve, error);
  progress_.next_dt = dt < progress_.next_dt * (1 - 1e-9) && next >= dt ? std::max(next, std::min(progress_.next_dt, next * 2)) : next;
  log_step(stage, dt, report);
  if (progress_.step % settings_.history_steps == 0) results_->write_history(balances_, histories, dt, report.newton_iterations);
  const double time = model_.store().committed().time;
  const bool by_time = settings_.field_interval > 0 && time >= progress_.next_field_time * (1 - 1e-12);
  const bool by_step = settings_.field_steps > 0 && progress_.step % settings_.field_steps == 0;
  const bool at_end = time >= (progress_.stage_start + stage.duration) * (1 - 1e-12);
  if (by_time || by_step || at_end) results_->write_fields(progress_.step, stage.name);
  while (settings_.field_interval > 0 && progress_.next_field_time <= time * (1 + 1e-12)) progress_.next_field_time += settings_.field_interval;
  if (settings_.checkpoint_steps > 0 && progress_.step % settings_.checkpoint_steps == 0) save_checkpoint();
}

ExitCode Run::run_stage(const Stage& stage) {
  const double end_tolerance = 1e-9 * stage.duration;
  while (model_.store().committed().time < progress_.stage_start + stage.duration - end_tolerance) {
    if (options_.maximum_steps > 0 && steps_here_ >= options_.maximum_steps) {
      save_checkpoint();
      log::info("stopped after " + std::to_string(steps_here_) + " steps; continue with --restart");
      return ExitCode::done;
    }
    if (progress_.step_in_stage >= stage.control.maximum_steps) {
      log::warn("stages/" + stage.name + "/time step/maximum steps: " + std::to_string(stage.control.maximum_steps) + " steps were taken and the stage is not over");
      save_checkpoint();
      return ExitCode::no_convergence;
    }
    double dt = choose_dt(stage);
    StepReport report;
    ExitCode exit = ExitCode::done;
    if (!take_step(stage, dt, report, exit)) {
      save_checkpoint();
      results_->write_fields(progress_.step, stage.name);
      return exit;
    }
    after_step(stage, dt, report);
    if (stop_requested()) {
      save_checkpoint();
      log::warn("stopped by a signal after step " + std::to_string(progress_.step) + "; continue with --restart");
      return ExitCode::stopped;
    }
  }
  return ExitCode::done;
}

ExitCode Run::execute() {
  wall_start_ = Teuchos::Time::wallTime();
  if (!options_.restart) results_->write_fields(0, "start");
  const auto& stages = model_.stages();
  // a restart between two stages: what was active in the one before is not newly activated in the next
  if (options_.restart && !progress_.stage_open && progress_.stage > 0) model_.activate(*stages[progress_.stage - 1], false);
  for (; progress_.stage < static_cast<int>(stages.size()); ++progress_.stage) {
    const Stage& stage = *stages[progress_.stage];
    if (!begin_stage(stage)) return ExitCode::no_convergence;
    if (stage.type == Stage::Type::geostatic) {
      if (!run_geostatic(stage)) {
        save_checkpoint();
        return ExitCode::no_convergence;
      }
      results_->write_fields(progress_.step, stage.name);
    } else {
      const ExitCode exit = run_stage(stage);
      const bool complete = model_.store().committed().time >= progress_.stage_start + stage.duration * (1 - 2e-9);
      if (exit != ExitCode::done || !complete) return exit;
      if (stage.reset_displacements) reset_displacements();
    }
    const bool last = progress_.stage + 1 == static_cast<int>(stages.size());
    if (last) break;  // its checkpoint is written below: it stays open, so that a restart may prolong it
    progress_.stage_open = false;
    ++progress_.stage;
    save_checkpoint();
    --progress_.stage;
  }
  save_checkpoint();
  char line[160];
  std::snprintf(line, sizeof line, "done: %d steps, %d rejected, %.1f s; results in %s.{xdmf,csv}", progress_.step, rejected_,
                Teuchos::Time::wallTime() - wall_start_, settings_.stem().c_str());
  log::info(line);
  const StepTimes& times = model_.stepper().times();
  std::snprintf(line, sizeof line, "time: residuals %.2f s, Jacobians %.2f s, linear solves %.2f s", times.residual, times.jacobian, times.linear);
  log::info(line);
  return ExitCode::done;
}

}  // namespace mudline
