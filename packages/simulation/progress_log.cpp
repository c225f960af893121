#include "simulation/progress_log.hpp"

#include <Teuchos_Time.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/log.hpp"
#include "core/told.hpp"
#include "integrator/stepper.hpp"
#include "simulation/model.hpp"

namespace mudline {

namespace {
constexpr int mean_of = 30;  // steps over which the time of a step is averaged
}  // namespace

void ProgressLog::begin_run(const RunView&) { wall_start_ = wall_last_ = Teuchos::Time::wallTime(); }

double ProgressLog::steps_left(const RunView& run) const {
  const double rest = run.at_end ? 0.0 : run.stage_start + run.stage.duration - run.state.time;
  double steps = run.stage.control.steps_for(rest, run.dt);
  const auto& stages = run.model.stages();
  for (std::size_t i = run.model.index_of(run.stage) + 1; i < stages.size(); ++i)
    if (stages[i]->type != Stage::Type::geostatic)
      steps += stages[i]->control.steps_for(stages[i]->duration, stages[i]->control.initial);
  return steps;
}

void ProgressLog::step(const RunView& run) {
  if (run.stage.type == Stage::Type::geostatic) return;
  const double wall = Teuchos::Time::wallTime(), taken = wall - wall_last_;
  wall_last_ = wall;
  wall_step_ += (taken - wall_step_) / std::min(++steps_, mean_of);
  const std::string augmented =
      run.solve.augmentations > 0 ? "  augmentations " + std::to_string(run.solve.augmentations) : "";
  char line[200];
  std::snprintf(line, sizeof line, "  step %5d  t %.6g s  dt %.3g s  newton %d%s  linear %d%s  about %s left", run.step,
                run.state.time, run.dt, run.solve.newton_iterations, augmented.c_str(), run.solve.linear_iterations,
                run.solve.factorisations > 0 ? "" : " (reused)",
                readable(std::round(wall_step_ * steps_left(run)), "s", 2).c_str());
  log::info(line);
}

void ProgressLog::end_run(const RunView& run, RunEnd end) {
  if (end != RunEnd::done) return;
  char line[160];
  std::snprintf(line, sizeof line, "done: %d steps, %d rejected, %.1f s", run.step, run.rejected,
                Teuchos::Time::wallTime() - wall_start_);
  log::info(std::string(line) + "; results in " + run.stem + ".{vtkhdf,csv}");
  const StepTimes& times = run.model.system().times();
  std::snprintf(line, sizeof line, "time: residuals %.2f s, Jacobians %.2f s, linear solves %.2f s, mesh motion %.2f s",
                times.residual, times.jacobian, times.linear, run.mesh_time);
  log::info(line);
}

}  // namespace mudline
