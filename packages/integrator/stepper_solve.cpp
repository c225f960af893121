// One attempt at a step: guess, Newton, augmentations.
#include <algorithm>

#include "integrator/overlap.hpp"
#include "integrator/stepper.hpp"

namespace mudline {

bool Stepper::stands_at(const Vector& x) const {
  bool same = stands_;
  if (same) {
    const auto here = evaluated_.getLocalViewHost(Tpetra::Access::ReadOnly),
               there = x.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t i = 0; same && i < here.extent(0); ++i) same = here(i, 0) == there(i, 0);
  }
  return sum_over_ranks(*space_.dofs()->comm(), same ? 0 : 1) == 0;
}

Augmentation Stepper::augment(int count) {
  Augmentation all;
  for (Term* term : active_) {
    const Augmentation one = term->augment(view_, count);
    all.again = all.again || one.again;
    if (all.refusal.empty()) all.refusal = one.refusal;
  }
  return all;
}

void Stepper::solve_step(const NewtonOptions& newton, Vector& x, StepReport& report) {
  for (;;) {
    const NewtonReport solved = newton_solve(*this, newton, x);
    const int before =
        report.augmentations == 0 ? 0 : report.newton_iterations;  // a prediction counts for the first solve
    report.newton_iterations += solved.iterations;
    report.hardest_solve = std::max(report.hardest_solve, report.newton_iterations - before);
    report.converged = solved.converged;
    report.reason = !solved.converged && !failure_.empty() ? failure_ : solved.reason;
    if (!solved.converged) return;
    // NOX may have evaluated elsewhere last (a line search); make the trial state that of the solution, bit for bit.
    Vector f(map());
    if (!stands_at(x) && !residual(x, f)) {
      report.converged = false;
      report.reason = failure_;
      return;
    }
    const Augmentation next = augment(report.augmentations);
    if (!next.refusal.empty()) {
      report.converged = false;
      report.reason = next.refusal;
      return;
    }
    if (!next.again) return;
    ++report.augmentations;
    stands_ = false;
    chord_.start_solve();
  }
}

std::string Stepper::hints() const {
  std::string all;
  for (const Term* term : active_)
    if (const std::string hint = term->hint(view_); !hint.empty()) all += "; " + hint;
  return all;
}

StepReport Stepper::attempt(const StepRequest& request, const StepTolerances& tolerances, const NewtonOptions& newton) {
  chord_.enabled = newton.reuse_jacobian;
  Vector x = begin(request, tolerances);
  const bool goes_on = newton.first_guess == NewtonOptions::FirstGuess::extrapolated && extrapolate(x);
  const int predicted = !goes_on && predict(x) ? 1 : 0;
  StepReport report;
  report.newton_iterations = predicted;
  solve_step(newton, x, report);
  report.linear_iterations = linear_iterations_;
  report.factorisations = factorisations_;
  if (!report.converged) {
    report.reason += hints();
    solver_.reset();
    chord_.forget();
    return report;
  }
  const std::vector<double> sizes = owned_field_norms(*space_.dofs(), x);
  for (int i = 0; i < space_.num_fields(); ++i) {
    reference_floor_[i] =
        std::max({reference_floor_[i], reference_[i], rounding_[i] / (floor_share * tolerances_.residual)});
    size_floor_[i] = std::max(size_floor_[i], sizes[i]);
  }
  return report;
}

}  // namespace mudline
