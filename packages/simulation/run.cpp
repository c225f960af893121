#include "simulation/run.hpp"

#include <Teuchos_Time.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include "ale/yield_drift.hpp"
#include "core/foreign_library.hpp"
#include "core/log.hpp"
#include "integrator/overlap.hpp"
#include "integrator/time_error.hpp"
#include "simulation/initial_rates.hpp"

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

std::string format(const char* pattern, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, pattern, value);
  return buffer;
}

std::string describe(const MeshQuality& quality, const Mesh& mesh) {
  return std::to_string(quality.poor) + " of " + std::to_string(mesh.num_global_elements()) +
         " elements have a scaled Jacobian below " + format("%.3g", MeshQuality::doubtful) + ", the smallest is " +
         format("%.3g", quality.lowest) + format(" at (%.4g, ", quality.place[0]) + format("%.4g", quality.place[1]) +
         (mesh.dimension() == 3 ? format(", %.4g)", quality.place[2]) : ")");
}

}  // namespace

void catch_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGUSR1, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // as under nohup
}

Run::Run(std::unique_ptr<Model> model, ModelMaker make_model, const OutputSettings& settings, const Origin& origin,
         const RunOptions& options)
    : model_(std::move(model)),
      make_model_(std::move(make_model)),
      settings_(settings),
      origin_(origin),
      options_(options),
      penetration_(options.doubts),
      balances_(std::make_unique<Balances>(*model_)) {
  error_estimate_ = make_error_estimate(*model_);
  std::filesystem::create_directories(settings_.folder);
  lock_ = std::make_unique<ResultLock>(model_->mesh().comm(), settings_.stem());
  if (options_.restart) {
    load_checkpoint();
    results_ = std::make_unique<Results>(*model_, settings_, origin_, error_estimate_.get(), results_restart());
    restore_initial_pressure();
    return;
  }
  make_room(model_->mesh().comm(), settings_.stem(), origin_, options_.overwrite);
  results_ = std::make_unique<Results>(*model_, settings_, origin_, error_estimate_.get(), std::nullopt);
  take_start();
}

std::unique_ptr<DiscretisationError> Run::make_error_estimate(Model& model) const {
  return settings_.error_estimate ? std::make_unique<DiscretisationError>(model, settings_.target_error) : nullptr;
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
    restore_solver();
    penetration_.begin_stage(*model_, report_contacts());
    return true;
  }
  log::info("stage '" + stage.name + "'");
  progress_.stage_open = true;
  if (error_estimate_) error_estimate_->begin_stage();
  progress_.step_in_stage = 0;
  progress_.stage_start = model_->store().committed().time;
  progress_.next_dt = stage.control.initial;
  count_increment(0);
  progress_.last_dt = 0;
  progress_.next_field_time = next_field_time(progress_.stage_start);
  model_->stepper().measures().begin_stage();
  if (!model_->stepper().refresh_history()) {
    log::error("the stresses of the start of stage '" + stage.name + "' cannot be evaluated" +
               model_->stepper().hints());
    return false;
  }
  const Stage* const before = progress_.stage > 0 ? model_->stages()[progress_.stage - 1].get() : nullptr;
  InitialRates(*model_, stage, before).give(request(stage, stage.control.initial));
  balances_->jump([&] { model_->start_bodies(stage); });
  if (model_->soil() && model_->soil()->pressure >= 0) walls_.begin(*model_, results_->excess_pressure());
  penetration_.begin_stage(*model_, report_contacts());
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
  const StepReport report = model_->stepper().attempt(now, model_->tolerances(), newton);
  check_foreign_code();
  model_->store().committed().time = time;
  if (!report.converged) {
    log::error("geostatic equilibrium of stage '" + stage.name + "' not found: " + report.reason);
    return false;
  }
  const int u = model_->space().find("displacement");
  double largest = 0;
  if (u >= 0)
    for (const auto& [begin, end] : overlap_ranges(*model_->space().dofs(), u))
      for (int i = begin; i < end; ++i)
        largest = std::max(largest, std::abs(model_->store().trial().value(i) - model_->store().committed().value(i)));
  largest = max_over_ranks(*model_->mesh().comm(), largest);
  log::info("  balanced in " + std::to_string(report.newton_iterations) + " iterations, largest displacement " +
            format("%.3g m", largest));
  if (stage.balance_tolerance > 0 && largest > stage.balance_tolerance) {
    log::error("stages/" + stage.name + "/balance tolerance: equilibrium needs displacements of " +
               format("%.3g m", largest) + ", more than the allowed " + format("%.3g m", stage.balance_tolerance) +
               "; check loads, supports and the initial stresses against each other");
    return false;
  }
  balances_->add_step();
  model_->store().trial().time = model_->store().committed().time;
  Kokkos::deep_copy(model_->store().trial().rate, 0.0);
  Kokkos::deep_copy(model_->store().trial().acceleration, 0.0);
  model_->store().accept();
  Report terms = report_terms();
  look_at_mesh();
  report_mesh(terms);
  ++progress_.step;
  reset_displacements();
  take_start();
  results_->write_history(*balances_, terms, 0.0, report.newton_iterations);
  return true;
}

void Run::take_start() {
  balances_->start();
  results_->take_initial_pressure();
  if (error_estimate_) error_estimate_->start();
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
  const double dt = model_->stepper().step_limit(std::min(progress_.next_dt, stage.control.maximum));
  const double left = end - time;
  if (dt > left * (1 - 1e-9)) return left;
  // two equal last steps instead of a full one and a sliver
  return dt > 0.5 * left && dt < left ? std::min(dt, 0.5 * left * (1 + 1e-12)) : dt;
}

LocalError Run::local_error(const Stage& stage) const {
  if (stage.control.error_tolerance <= 0) return {};
  Stepper& stepper = model_->stepper();
  return TimeError(model_->space())
      .measure(stepper.view(), stage.scheme(progress_.step_in_stage), progress_.last_dt, progress_.step_in_stage,
               stepper.measures().values, stage.control.error_tolerance);
}

Report Run::report_terms() {
  Report report;
  const StepView& view = model_->stepper().view();
  for (Reports* term : model_->stepper().reports()) term->histories(view, report);
  const auto& active = model_->stepper().active();
  for (const auto& [name, contact] : model_->contacts()) {
    if (std::find(active.begin(), active.end(), contact.get()) != active.end()) continue;
    Report own;
    contact->histories(view, own);
    for (const auto& [key, quantity] : own)
      report[key] = {quantity.unit, quantity.lasting ? quantity.value : 0.0, quantity.lasting};
  }
  Report shares;
  for (const auto& condition : model_->conditions()) condition->reactions(model_->stepper().reaction(), shares);
  for (const auto& [name, body] : model_->bodies()) {
    const BodyUnknowns& unknowns = body->unknowns();
    const int axes = body->dimension();
    for (int k = 0; k < unknowns.count; ++k) {
      const int direction = unknowns.direction[k];
      const bool turns = direction >= axes;
      const std::string axis = turns && axes == 2 ? "" : " " + std::string(axis_names[direction % axes]);
      shares["body/" + name + (turns ? "/driving moment" : "/driving force") + axis] = {
          turns ? "N m" : "N", model_->stepper().reaction()(unknowns.dof[k]) / unknowns.scale[k]};
    }
  }
  for (const auto& [name, share] : shares)
    report[name] = {share.unit, sum_over_ranks(*model_->mesh().comm(), share.value)};
  return report;
}

Report Run::report_contacts() {
  Report report;
  StepView view = model_->stepper().view();  // after a restart it belongs to no step yet
  view.committed = &model_->store().committed();
  for (const auto& [name, contact] : model_->contacts()) contact->histories(view, report);
  return report;
}

bool Run::take_step(const Stage& stage, double& dt, StepReport& report, ExitCode& exit) {
  for (;;) {
    if (moves_mesh(stage)) model_->store().keep();
    Stepper& stepper = model_->stepper();
    const OpenDescriptors before;
    report = stepper.attempt(request(stage, dt), model_->tolerances(), model_->newton());
    check_foreign_code(&before);
    double next = -1;
    if (report.converged) {
      error_ = local_error(stage);
      next = stage.control.after_error(dt, error_);
      if (next < 0 && accept(stage, report)) return true;
      if (next > 0) report.reason = "time error " + format("%.2g", error_.ratio) + " times its tolerance";
      stepper.reject();
    }
    ++rejected_;
    if (next < 0) next = stage.control.after_failure(dt);
    const double time = model_->store().committed().time;
    if (next < 0 || stop_requested()) {
      exit = next < 0 ? ExitCode::no_convergence : ExitCode::stopped;
      if (next < 0)
        log::error("step " + std::to_string(progress_.step + 1) + ", t = " + format("%.6g s", time) + ": " +
                   report.reason + "; the step cannot be cut below " + format("%.3g s", stage.control.minimum));
      return false;
    }
    log::info("  step " + std::to_string(progress_.step + 1) + " rejected: " + report.reason + "; dt " +
              format("%.3g", dt) + " -> " + format("%.3g s", next));
    dt = progress_.next_dt = next;
  }
}

void Run::log_step(const Stage& stage, double dt, const StepReport& report) const {
  const double time = model_->store().committed().time, done = time - progress_.stage_start;
  const double wall = Teuchos::Time::wallTime() - wall_start_;
  const double left = steps_here_ > 0 && done > 0 ? (stage.duration - done) / dt * wall / steps_here_ : 0;
  const std::string augmented =
      report.augmentations > 0 ? "  augmentations " + std::to_string(report.augmentations) : "";
  char line[200];
  std::snprintf(line, sizeof line, "  step %5d  t %.6g s  dt %.3g s  newton %d%s  linear %d%s  about %.0f s left",
                progress_.step, time, dt, report.newton_iterations, augmented.c_str(), report.linear_iterations,
                report.factorisations > 0 ? "" : " (reused)", left);
  log::info(line);
}

bool Run::accept(const Stage& stage, StepReport& report) {
  if (moves_mesh(stage) && !stage.allow_folded && folds_elements()) {
    report.reason = "the step folds elements";
    report.converged = false;
    return false;
  }
  balances_->add_step();
  model_->store().accept();
  count_increment(1);
  report_ = report_terms();
  const bool moves = moves_mesh(stage) && model_->ale()->due(progress_.step + 1, model_->store().committed());
  const std::string veto = moves ? relocate_mesh() : "";
  if (!veto.empty()) {
    report.reason = veto;
    model_->store().restore();
    report.converged = false;
    return false;
  }
  look_at_mesh();
  penetration_.look(*model_, report_);
  report_mesh(report_);
  return true;
}

bool Run::folds_elements() const {
  const Ale& ale = *model_->ale();
  return !(ale.quality(model_->store().trial()) > 0) && ale.quality(model_->store().committed()) > 0;
}

bool Run::moves_mesh(const Stage& stage) const { return model_->ale() && stage.mesh_motion; }

std::string Run::relocate_mesh() {
  StateStore& store = model_->store();
  const std::vector<double> conserved = balances_->conserved();
  MeshReceipt receipt = model_->ale()->relocate(store, model_->stepper().constraints());
  if (!receipt.moved) return receipt.veto;
  // the trial state still has the old mesh
  for (Transferred* term : model_->stepper().transferred())
    term->relocate(store.trial().coordinates, store.committed());
  if (!model_->stepper().refresh_history()) return "the remapped state cannot be evaluated" + model_->stepper().hints();
  receipt.yield_drift = yield_drift(*model_->soil(), store.committed(), store.trial());
  for (Transferred* term : model_->stepper().transferred()) term->take_evaluated(store.trial(), store.committed());
  balances_->add_remap(receipt);
  balances_->add_remap_of_conserved(conserved);
  tell_transfer(receipt, "    mesh moved: " + format("Courant %.2f, ", receipt.largest_motion), log::detail);
  return "";
}

void Run::tell_transfer(const MeshReceipt& receipt, const std::string& begin, void (*tell)(const std::string&)) {
  const auto share = [](double before, double after) { return before != 0 ? after / before - 1 : 0.0; };
  char line[240];
  std::snprintf(line, sizeof line,
                "quality %.2f -> %.2f, grains %+.1e, water %+.1e, restored %+.1e, kinetic energy %+.1e, "
                "yield drift %.1e",
                receipt.quality_before, receipt.quality, share(receipt.before.solid, receipt.after.solid),
                share(receipt.before.water, receipt.after.water), receipt.restored_solid,
                share(receipt.before.kinetic, receipt.after.kinetic), receipt.yield_drift);
  tell(begin + line);
  if (model_->soil()->layered()) tell(layers_text(receipt));
  if (receipt.started == 0 || restarted_laws_) return;
  restarted_laws_ = true;
  log::warn("laws start anew at " + std::to_string(receipt.started) + " points where the soil has become another " +
            "one, the first of " + receipt.started_where + ", at t " +
            format("%.6g s", model_->store().committed().time) +
            ": no soil of that material was within an element, so that its state variables (preconsolidation pressure "
            "and the like) follow from stress and void ratio there and its history is lost; doubt them there (smaller "
            "elements across the layers help; 'mesh motion/laws started anew' counts on)");
}

std::string Run::layers_text(const MeshReceipt& receipt) const {
  std::string text = "    layers: points of another material " + std::to_string(receipt.changed) +
                     ", laws started anew " + std::to_string(receipt.started) + "; grains restored";
  const auto& materials = model_->soil()->materials;
  for (std::size_t k = 0; k < materials.size(); ++k)
    text += (k > 0 ? ", " : " ") + materials[k]->name +
            format(" %+.1e", receipt.restored_grains[k] / std::max(receipt.before.grains[k], 1e-300));
  return text;
}

void Run::look_at_mesh() {
  const State& state = model_->store().committed();
  quality_ = mesh_quality(model_->mesh(), state.coordinates);
  if (poor_mesh_ || quality_.lowest >= MeshQuality::doubtful) return;
  poor_mesh_ = true;
  log::warn("the mesh is poor: " + describe(quality_, model_->mesh()) + " at t " + format("%.6g s", state.time) +
            "; doubt the results there (a 'mesh motion' or another mesh helps)");
}

void Run::report_mesh(Report& report) const {
  report["mesh/quality"] = {"-", quality_.lowest};
  if (!model_->ale() || !model_->ale()->remeshing()) return;
  report["mesh/elements"] = {"-", static_cast<double>(model_->mesh().num_global_elements())};
  report["mesh/remeshings"] = {"-", static_cast<double>(model_->ale()->remeshings())};
}

bool Run::ends_folded(const Stage& stage) const {
  if (stage.allow_folded || quality_.folded == 0) return false;
  log::error("the mesh is folded: " + describe(quality_, model_->mesh()) + " at t " +
             format("%.6g s", model_->store().committed().time) + "; the state is saved and the run ends here: use a " +
             "'mesh motion' or another mesh, or go on with stages/" + stage.name + "/allow folded elements = true");
  return true;
}

void Run::tell_dissipation(const Stage& stage) {
  if (!model_->soil() || model_->soil()->pressure < 0) return;
  for (const WallDissipation::Line& line : walls_.end(*model_, results_->excess_pressure(), stage.duration))
    line.doubtful ? log::warn(line.text) : log::info("  " + line.text);
}

double Run::next_field_time(double time) const {
  const double interval = settings_.field_interval;
  if (interval <= 0) return time;
  const double passed = std::floor((time - progress_.stage_start) / interval * (1 + 1e-12));
  // an interval below the resolution of the time counts as reached at every moment
  return passed < 1e12 ? progress_.stage_start + (passed + 1) * interval : time;
}

void Run::after_step(const Stage& stage, double dt, const StepReport& report) {
  ++progress_.step;
  ++progress_.step_in_stage;
  ++steps_here_;
  progress_.last_dt = dt;
  // a step that was shortened to meet the end of a stage or a contact's limit does not show how large a step Newton's
  // method can take
  const double next = stage.control.after_success(dt, report.hardest_solve, error_);
  progress_.next_dt =
      dt < progress_.next_dt * (1 - 1e-9) && next >= dt ? std::max(next, std::min(progress_.next_dt, next * 2)) : next;
  log_step(stage, dt, report);
  iterations_ = report.newton_iterations;
  row_is_due_ = true;
  const double time = model_->store().committed().time;
  const bool by_time = settings_.field_interval > 0 && time >= progress_.next_field_time * (1 - 1e-12);
  const bool by_step = settings_.field_steps > 0 && progress_.step % settings_.field_steps == 0;
  const bool at_end = time >= (progress_.stage_start + stage.duration) * (1 - 1e-12);
  if (at_end || progress_.step % settings_.history_steps == 0) write_row();
  if (by_time || by_step || at_end) results_->write_fields(progress_.step, stage.name);
  if (by_time) progress_.next_field_time = next_field_time(time);
  if (settings_.checkpoint_steps > 0 && progress_.step % settings_.checkpoint_steps == 0) save_checkpoint();
}

void Run::write_row() {
  if (row_is_due_) results_->write_history(*balances_, report_, progress_.last_dt, iterations_);
  row_is_due_ = false;
}

void Run::save_and_end() {
  save_checkpoint();
  write_row();
}

ExitCode Run::run_stage() {
  const double duration = stage().duration, end_tolerance = 1e-9 * duration;
  while (model_->store().committed().time < progress_.stage_start + duration - end_tolerance) {
    if (options_.maximum_steps > 0 && steps_here_ >= options_.maximum_steps) {
      save_and_end();
      log::info("stopped after " + std::to_string(steps_here_) + " steps; continue with --restart");
      return ExitCode::done;
    }
    if (remeshing_due()) remesh();
    const Stage& stage = this->stage();
    if (progress_.step_in_stage >= stage.control.maximum_steps) {
      log::error("stages/" + stage.name + "/time step/maximum steps: " + std::to_string(stage.control.maximum_steps) +
                 " steps were taken and the stage is not over");
      save_and_end();
      return ExitCode::no_convergence;
    }
    double dt = choose_dt(stage);
    StepReport report;
    ExitCode exit = ExitCode::done;
    if (!take_step(stage, dt, report, exit)) {
      save_and_end();
      results_->write_fields(progress_.step, stage.name);
      return exit;
    }
    after_step(stage, dt, report);
    if (ends_folded(stage)) {
      save_and_end();
      results_->write_fields(progress_.step, stage.name);
      return ExitCode::no_convergence;
    }
    if (stop_requested()) {
      save_and_end();
      log::warn("stopped by a signal after step " + std::to_string(progress_.step) + "; continue with --restart");
      return ExitCode::stopped;
    }
  }
  write_row();
  return ExitCode::done;
}

ExitCode Run::execute() {
  wall_start_ = Teuchos::Time::wallTime();
  if (!options_.restart) results_->write_fields(0, "start");
  look_at_mesh();
  const int stages = static_cast<int>(model_->stages().size());
  // after a restart between two stages the terms of the stage before are active already and do not start anew
  if (options_.restart && !progress_.stage_open && progress_.stage > 0)
    model_->activate(*model_->stages()[progress_.stage - 1], false);
  for (; progress_.stage < stages; ++progress_.stage) {
    const Stage& stage = this->stage();
    if (!begin_stage(stage)) return ExitCode::no_convergence;
    if (stage.type == Stage::Type::geostatic) {
      if (!run_geostatic(stage)) {
        save_checkpoint();
        return ExitCode::no_convergence;
      }
      results_->write_fields(progress_.step, stage.name);
    } else {
      const double duration = stage.duration;
      const ExitCode exit = run_stage();  // remeshing replaces the stages by others of the same names
      const bool complete = model_->store().committed().time >= progress_.stage_start + duration * (1 - 2e-9);
      if (exit != ExitCode::done || !complete) return exit;
      penetration_.end_stage(*model_, report_);
      tell_dissipation(this->stage());
      if (this->stage().reset_displacements) reset_displacements();
    }
    const bool last = progress_.stage + 1 == stages;
    // the checkpoint of the last stage is written below with the stage open, so that a restart may prolong it
    if (last) break;
    progress_.stage_open = false;
    ++progress_.stage;
    save_checkpoint();
    --progress_.stage;
  }
  check_foreign_code();
  save_checkpoint();
  results_->look_at_files();
  penetration_.tell_end();
  char line[160];
  std::snprintf(line, sizeof line, "done: %d steps, %d rejected, %.1f s", progress_.step, rejected_,
                Teuchos::Time::wallTime() - wall_start_);
  log::info(std::string(line) + "; results in " + settings_.stem() + ".{xdmf,csv}");
  const StepTimes& times = model_->stepper().times();
  std::snprintf(line, sizeof line, "time: residuals %.2f s, Jacobians %.2f s, linear solves %.2f s", times.residual,
                times.jacobian, times.linear);
  log::info(line);
  return ExitCode::done;
}

}  // namespace mudline
