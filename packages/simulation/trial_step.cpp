#include "simulation/trial_step.hpp"

#include <sys/resource.h>
#include <Teuchos_Time.hpp>

#include <algorithm>

#include "integrator/overlap.hpp"
#include "integrator/stepper.hpp"
#include "simulation/initial_rates.hpp"
#include "simulation/stage.hpp"

namespace mudline {

namespace {

/// Largest memory of this process so far [bytes].
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

const Stage* first_in_time(const Model& model) {
  for (const auto& stage : model.stages())
    if (stage->type != Stage::Type::geostatic) return stage.get();
  return nullptr;
}

/// `seconds`: wall time of a step [s], of a second attempt where the first one converged: only that one prepares.
StepReport attempt(Model& model, const Stage& stage, double& seconds) {
  StepSystem& system = model.system();
  model.activate(stage, true);
  model.store().committed().increment = {static_cast<int>(model.index_of(stage)) + 1, 1, 0};
  system.convergence().begin_stage();
  StepReport report;
  if (!system.refresh_history()) {
    report.reason = "the stresses of the start cannot be evaluated" + system.hints();
    return report;
  }
  StepRequest request;
  request.dt = system.terms().step_limit(std::min({stage.control.initial, stage.control.maximum, stage.duration}));
  request.scheme = stage.scheme(0);
  request.prescribe = [&](double t_old, double t_end, const State& committed, Constraints& to) {
    model.prescribe(stage, t_old, t_end, committed, to);
  };
  InitialRates(model, stage, nullptr).give(request);
  model.start_bodies(stage);
  const auto timed = [&] {
    const double begin = Teuchos::Time::wallTime();
    report = Stepper(system).attempt(request, model.tolerances(), model.newton());
    seconds = max_over_ranks(*model.mesh().comm(), Teuchos::Time::wallTime() - begin);
  };
  timed();
  if (report.converged) timed();
  return report;
}

}  // namespace

TrialStep try_first_step(Model& model) {
  TrialStep trial;
  const Stage* const stage = first_in_time(model);
  const Comm& comm = *model.mesh().comm();
  if (stage) {
    trial.stage = stage->name;
    const StepReport report = attempt(model, *stage, trial.seconds);
    trial.iterations = report.newton_iterations;
    if (!report.converged) trial.failure = report.reason;
  }
  trial.largest_memory = max_over_ranks(comm, peak_memory());
  trial.memory = sum_over_ranks(comm, peak_memory());
  return trial;
}

double expected_steps(const Model& model) {
  double steps = 0;
  for (const auto& stage : model.stages())
    steps +=
        stage->type == Stage::Type::geostatic ? 1 : stage->control.steps_for(stage->duration, stage->control.initial);
  return steps;
}

}  // namespace mudline
