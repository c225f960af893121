#include "integrator/first_guess.hpp"

#include <algorithm>

#include "algebra/ordered_sum.hpp"
#include "integrator/overlap.hpp"

namespace mudline {

namespace {

/// Adds time times rate to the unknowns [begin, end) of x that are not prescribed.
void move_on(const Constraints& constraints, const NodalView& rates, double time, int begin, int end, Vector& x) {
  const auto data = entries(x, Tpetra::Access::ReadWrite);
  const Kokkos::View<char*> prescribed = constraints.mask;
  const NodalView rate = rates;
  Kokkos::parallel_for(
      "first guess", Kokkos::RangePolicy<>(begin, end), KOKKOS_LAMBDA(int i) {
        if (!prescribed(i)) data(i) += time * rate(i);
      });
}

/// Sums of squares of the change of forces and of the forces before it.
struct SquaresOfChange {
  NodalView now, old;
  KOKKOS_FUNCTION void operator()(int i, double (&sums)[2]) const {
    sums[0] += (now(i) - old(i)) * (now(i) - old(i));
    sums[1] += old(i) * old(i);
  }
};

}  // namespace

Vector extrapolated(const StepSystem& system, const Vector& x, const NodalView& rates) {
  Vector result(x, Teuchos::Copy);
  const Space& space = system.space();
  const DofMap& dofs = *space.dofs();
  for (int f = 0; f < space.num_fields(); ++f)
    if (space.field(f).time_order > 0)
      move_on(system.constraints(), rates, system.view().dt, dofs.owned_begin(f), dofs.owned_end(f), result);
  return result;
}

double largest_ratio(const std::vector<double>& norms, const std::vector<double>& scales,
                     const std::vector<double>& other_scales) {
  double largest = 0;
  for (std::size_t f = 0; f < norms.size(); ++f)
    largest = std::max(largest, norms[f] / std::max({scales[f], other_scales[f], 1e-300}));
  return largest;
}

int FirstGuess::improve(Vector& x, const NewtonOptions& options) {
  solved_ = 0;
  on_trial_ = false;
  const bool extrapolates = options.first_guess == NewtonOptions::FirstGuess::extrapolated;
  if (!extrapolates || !extrapolate(x, options.guess_on_trial)) predict(x);
  return solved_;
}

NodalView FirstGuess::rates() const {
  const State& old = system_.store().committed();
  if (system_.scheme().inertia) return old.rate;
  const Space& space = system_.space();
  const NodalView result("first guess", old.rate.extent(0));
  for (int f = 0; f < space.num_fields(); ++f) {
    const NodalView from = space.field(f).support == Support::apart ? old.rate : old.predictor;
    for (const auto& range : overlap_ranges(*space.dofs(), f))
      Kokkos::deep_copy(Kokkos::subview(result, range), Kokkos::subview(from, range));
  }
  return result;
}

bool FirstGuess::extrapolate(Vector& x, bool may_try) {
  if (!system_.scheme().flow) return false;  // geostatic: no time passes
  Vector guess = extrapolated(system_, x, rates());
  Vector change(guess, Teuchos::Copy), f(system_.map());
  change.update(-1, x, 1);
  if (change.norm2() == 0) return false;
  // A body that stops or presses against something stiff is further from the solution after a step at its old rate.
  const DofMap& dofs = *system_.space().dofs();
  const bool here = system_.evaluate(x, false, f);
  const std::vector<double> resting = owned_field_norms(dofs, f), acting = system_.convergence().acting();
  if (!system_.residual(guess, f)) return false;
  const std::vector<double> moving = owned_field_norms(dofs, f), &now_acting = system_.convergence().acting();
  const bool worse = here && largest_ratio(moving, acting, now_acting) > largest_ratio(resting, acting, now_acting);
  if (worse) on_trial_ = may_try && !system_.scheme().inertia && iterate(guess, f, moving);
  if (worse && !on_trial_) return false;
  Tpetra::deep_copy(x, guess);
  return true;
}

bool FirstGuess::iterate(Vector& x, Vector& f, const std::vector<double>& before) {
  // Soil that flows on as before keeps its stresses but for the pressure, because the rates are not quite those of no
  // change of volume at the next place. Its stiffness against that is large, and so are the forces, but one iteration
  // takes them away. Where the contact has changed it does not, and the state at rest is the better start.
  constexpr double half = 0.5;
  const std::vector<double> acting = system_.convergence().acting();
  system_.forget_jacobian();
  Vector correction(system_.map());
  system_.solve_roughly(f);
  const bool solved = system_.jacobian(x) && system_.solve(f, correction);
  solved_ += solved ? 1 : 0;
  if (solved) x.update(-1, correction, 1);
  const bool evaluated = solved && system_.residual(x, f);
  const std::vector<double>& now_acting = system_.convergence().acting();
  if (evaluated && largest_ratio(owned_field_norms(*system_.space().dofs(), f), acting, now_acting) <
                       half * largest_ratio(before, acting, now_acting))
    return true;
  system_.forget_jacobian();
  return false;
}

void FirstGuess::predict(Vector& x) {
  const std::vector<Unilateral*>& unilateral = system_.terms().unilateral();
  const bool asked = std::any_of(unilateral.begin(), unilateral.end(),
                                 [](const Unilateral* term) { return term->asks_for_prediction(); });
  for (Unilateral* term : unilateral) term->predicting(asked);
  predict_linear(x, asked);
  for (Unilateral* term : unilateral) term->predicting(false);
  if (!asked) return;
  // neither state nor Jacobian of the linearised prediction may enter the iteration
  system_.forget_evaluation();
  system_.forget_jacobian();
}

bool FirstGuess::rests() const {
  const State &trial = system_.store().trial(), &committed = system_.store().committed();
  double sums[2] = {0, 0};  // squares of F at rest minus F_n, and of F_n, on this rank
  const ActingTerms& terms = system_.terms();
  for (int k = 0; k < static_cast<int>(terms.active().size()); ++k) {
    const int slot = terms.history_slot(k);
    if (slot < 0 || !face<History>(*terms.active()[k])->may_relax()) continue;
    const NodalView now = trial.history_forces[slot], old = committed.history_forces[slot];
    const auto here = ordered_sum<2>("rests", 0, static_cast<int>(old.extent(0)), SquaresOfChange{now, old});
    for (int n = 0; n < 2; ++n) sums[n] += here[n];
  }
  const auto total = sum_over_ranks(*system_.space().dofs()->comm(), std::vector<double>(sums, sums + 2));
  return total[0] <= 1e-6 * total[1];
}

void FirstGuess::predict_linear(Vector& x, bool always) {
  const Vector old = owned_part(*system_.space().dofs(), system_.store().committed().value);
  Vector moved(system_.map());
  moved.update(1, x, -1, old, 0);
  const bool moves = moved.norm2() > 0;
  if (!moves && !always) return;
  // The columns of prescribed unknowns are not in the matrix: their product with the change is differenced. The
  // fraction is small enough for the elements next to the moving nodes, large enough against rounding.
  constexpr double fraction = 1e-3;
  Vector f(system_.map()), shifted(system_.map()), part(old, Teuchos::Copy), correction(system_.map());
  part.update(fraction, moved, 1);
  if (moves && !system_.evaluate(part, false, shifted)) return;
  if (!system_.residual(old, f) || !rests()) return;
  system_.forget_jacobian();  // the rate of convergence of an old Jacobian is not known here
  if (!system_.jacobian(old)) return;
  if (moves) f.update(1 / fraction, shifted, 1 - 1 / fraction);
  if (!system_.solve(f, correction)) return;
  x.update(-1, correction, 1);
  ++solved_;
}

}  // namespace mudline
