// The first guess of a step: by the linear answer to prescribed unknowns that move, or by the velocities of the step
// before.
#include <algorithm>

#include "integrator/overlap.hpp"
#include "integrator/stepper.hpp"

namespace mudline {

bool Stepper::predict(Vector& x) {
  const bool asked =
      std::any_of(active_.begin(), active_.end(), [](Term* term) { return term->asks_for_prediction(); });
  for (Term* term : active_) term->predicting(asked);
  const bool predicted = predict_linear(x, asked);
  for (Term* term : active_) term->predicting(false);
  if (!asked) return predicted;
  // nothing of the more linear step may enter the iteration: no state, no Jacobian
  stands_ = false;
  chord_.forget();
  return predicted;
}

bool Stepper::rests() const {
  double sums[2] = {0, 0};  // squares of F at rest less F_n, and of F_n: this rank's
  for (int k = 0; k < static_cast<int>(active_.size()); ++k) {
    if (!active_[k]->may_relax()) continue;
    const int slot = history_slot(k);
    const NodalView now = store_.trial().history_forces[slot], old = store_.committed().history_forces[slot];
    for (std::size_t i = 0; i < old.extent(0); ++i) {
      sums[0] += (now(i) - old(i)) * (now(i) - old(i));
      sums[1] += old(i) * old(i);
    }
  }
  const auto total = sum_over_ranks(*space_.dofs()->comm(), std::vector<double>(sums, sums + 2));
  return total[0] <= 1e-6 * total[1];
}

bool Stepper::predict_linear(Vector& x, bool always) {
  const Vector old = owned_part(*space_.dofs(), store_.committed().value);
  Vector moved(map());
  moved.update(1, x, -1, old, 0);
  const bool moves = moved.norm2() > 0;
  if (!moves && !always) return false;
  // The columns of prescribed unknowns are not in the matrix: their product with the change is differenced. The
  // fraction is small enough for the elements next to the moving nodes, large enough against rounding.
  constexpr double fraction = 1e-3;
  Vector f(map()), shifted(map()), part(old, Teuchos::Copy), correction(map());
  part.update(fraction, moved, 1);
  if (moves && !residual(part, shifted)) return false;
  if (!residual(old, f) || !rests()) return false;
  chord_.forget();  // its rate of convergence is not known here
  if (!jacobian(old)) return false;
  if (moves) f.update(1 / fraction, shifted, 1 - 1 / fraction);
  if (!solve(f, correction)) return false;
  x.update(-1, correction, 1);
  return true;
}

bool Stepper::extrapolate(Vector& x) {
  if (!scheme_.flow) return false;  // geostatic: no time passes
  const State& old = store_.committed();
  Vector guess(x, Teuchos::Copy);
  {
    auto data = guess.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (int f = 0; f < space_.num_fields(); ++f) {
      if (space_.field(f).time_order != 2) continue;
      for (int i = space_.dofs()->owned_begin(f); i < space_.dofs()->owned_end(f); ++i)
        if (!constraints_.mask(i)) data(i, 0) += view_.dt * old.rate(i);
    }
  }
  Vector change(guess, Teuchos::Copy), f(map());
  change.update(-1, x, 1);
  if (change.norm2() == 0 || !residual(guess, f)) return false;
  Tpetra::deep_copy(x, guess);
  return true;
}

}  // namespace mudline
