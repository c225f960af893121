#include "simulation/progress_log.hpp"

#include <Teuchos_Time.hpp>

#include <cstdio>

#include "core/log.hpp"
#include "integrator/stepper.hpp"
#include "simulation/model.hpp"

namespace mudline {

void ProgressLog::begin_run(const RunView&) { wall_start_ = Teuchos::Time::wallTime(); }

void ProgressLog::step(const RunView& run) {
  if (run.stage.type == Stage::Type::geostatic) return;
  ++steps_;
  const double done = run.state.time - run.stage_start, wall = Teuchos::Time::wallTime() - wall_start_;
  const double left = done > 0 ? (run.stage.duration - done) / run.dt * wall / steps_ : 0;
  const std::string augmented =
      run.solve.augmentations > 0 ? "  augmentations " + std::to_string(run.solve.augmentations) : "";
  char line[200];
  std::snprintf(line, sizeof line, "  step %5d  t %.6g s  dt %.3g s  newton %d%s  linear %d%s  about %.0f s left",
                run.step, run.state.time, run.dt, run.solve.newton_iterations, augmented.c_str(),
                run.solve.linear_iterations, run.solve.factorisations > 0 ? "" : " (reused)", left);
  log::info(line);
}

void ProgressLog::end_run(const RunView& run, RunEnd end) {
  if (end != RunEnd::done) return;
  char line[160];
  std::snprintf(line, sizeof line, "done: %d steps, %d rejected, %.1f s", run.step, run.rejected,
                Teuchos::Time::wallTime() - wall_start_);
  log::info(std::string(line) + "; results in " + run.stem + ".{xdmf,csv}");
  const StepTimes& times = run.model.system().times();
  std::snprintf(line, sizeof line, "time: residuals %.2f s, Jacobians %.2f s, linear solves %.2f s", times.residual,
                times.jacobian, times.linear);
  log::info(line);
}

}  // namespace mudline
