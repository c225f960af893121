#include "integrator/stepper.hpp"

#include <algorithm>

#include "core/log.hpp"
#include "integrator/first_guess.hpp"

namespace mudline {

Augmentation Stepper::augment(int count) {
  Augmentation all;
  for (Unilateral* term : system_.terms().unilateral()) {
    const Augmentation one = term->augment(system_.view(), count);
    all.again = all.again || one.again;
    if (all.refusal.empty()) all.refusal = one.refusal;
  }
  return all;
}

void Stepper::solve_step(const NewtonOptions& newton, Vector& x, StepReport& report) {
  for (;;) {
    const NewtonReport solved = newton_solve(system_, newton, x);
    const int before =
        report.augmentations == 0 ? 0 : report.newton_iterations;  // a prediction counts for the first solve
    report.newton_iterations += solved.iterations;
    report.hardest_solve = std::max(report.hardest_solve, report.newton_iterations - before);
    report.converged = solved.converged;
    report.reason = !solved.converged && !system_.failure().empty() ? system_.failure() : solved.reason;
    if (!solved.converged) return;
    // NOX may have evaluated elsewhere last (a line search); make the trial state that of the solution, bit for bit.
    Vector f(system_.map());
    if (!system_.residual(x, f)) {
      report.converged = false;
      report.reason = system_.failure();
      return;
    }
    const Augmentation next = augment(report.augmentations);
    if (!next.refusal.empty()) {
      report.converged = false;
      report.refused = true;
      report.reason = next.refusal;
      return;
    }
    if (!next.again) return;
    ++report.augmentations;
    system_.start_solve();
  }
}

StepReport Stepper::try_step(const StepRequest& request, const StepTolerances& tolerances,
                             const NewtonOptions& newton) {
  Vector x = system_.begin(request, tolerances);
  StepReport report;
  FirstGuess guess(system_);
  report.newton_iterations = guess.improve(x, newton);
  report.on_trial = guess.on_trial();
  solve_step(newton, x, report);
  report.linear_iterations = system_.linear_iterations();
  report.factorisations = system_.factorisations();
  if (report.converged && !system_.complete()) {
    report.converged = false;
    report.reason = system_.failure();
  }
  if (report.converged) {
    system_.convergence().accept(x);
    Kokkos::deep_copy(system_.store().trial().predictor, system_.store().trial().rate);
  } else {
    report.reason += system_.hints();
    system_.forget_solver();
  }
  return report;
}

StepReport Stepper::attempt(const StepRequest& request, const StepTolerances& tolerances, const NewtonOptions& newton) {
  std::vector<NewtonOptions> ways = newton.ways();
  StepReport report;
  std::string reason;  // that of the first way
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const NewtonOptions way = ways[k];
    const StepReport before = report;
    system_.set_options(way);
    report = try_step(request, tolerances, way);
    report.retried = k > 0;
    report.newton_iterations += before.newton_iterations;
    report.linear_iterations += before.linear_iterations;
    report.factorisations += before.factorisations;
    if (way.elastic_share) system_.forget_jacobian();
    if (report.converged || report.refused) return report;
    if (report.on_trial) ways.insert(ways.begin() + k + 1, newton.from_balance());
    if (reason.empty()) reason = report.reason;
    if (k + 1 < ways.size()) log::detail("    the step is tried once more: " + report.reason);
  }
  report.reason = reason;
  return report;
}

}  // namespace mudline
