#include "simulation/initial_rates.hpp"

#include <algorithm>
#include <cmath>

#include "core/log.hpp"
#include "core/told.hpp"
#include "integrator/consistent_rates.hpp"
#include "integrator/overlap.hpp"

namespace mudline {

namespace {

/// Rates are kept where their imbalance is below this share of the imbalance at rest.
constexpr double fits = 0.5;

}  // namespace

void InitialRates::give(const StepRequest& first) const {
  State& state = model_.store().committed();
  const bool keeps = stage_.initial_rates == Stage::InitialRates::keep ||
                     (stage_.initial_rates == Stage::InitialRates::automatic && stage_.type == Stage::Type::dynamic);
  if (!keeps) Kokkos::deep_copy(state.acceleration, 0.0);
  if (stage_.initial_rates == Stage::InitialRates::zero)
    for (const NodalView& rates : {state.rate, state.predictor}) Kokkos::deep_copy(rates, 0.0);
  if (stage_.type != Stage::Type::dynamic) return;
  if (before_ && before_->type == Stage::Type::quasi_static) judge(first);
  if (stage_.initial_rates == Stage::InitialRates::consistent &&
      !give_consistent_rates(model_.system(), first, model_.tolerances().linear)) {
    log::warn("initial accelerations cannot be computed; stage '" + stage_.name + "' starts from zero ones");
    Kokkos::deep_copy(state.acceleration, 0.0);
  }
}

void InitialRates::judge(const StepRequest& first) const {
  const double velocity = largest_velocity();
  if (velocity == 0 || misfit_of_rates(model_.system(), first, model_.tolerances()) < fits) return;
  const std::string found = "stage '" + before_->name + "' without inertia left velocities of up to " + told(velocity) +
                            " m/s, which its loads made and nothing in stage '" + stage_.name + "' keeps up";
  if (stage_.initial_rates == Stage::InitialRates::keep) {
    log::warn(found +
              "; the soil starts with them, as 'initial rates' = keep says: 'zero' or 'automatic' starts at rest");
    return;
  }
  clear();
  log::info("  " + found + ": it starts at rest");
}

void InitialRates::clear() const {
  const Space& space = model_.space();
  const NodalView rate = model_.store().committed().rate;
  for (int f = 0; f < space.num_fields(); ++f)
    if (space.field(f).support != Support::apart)
      for (const auto& range : overlap_ranges(*space.dofs(), f)) Kokkos::deep_copy(Kokkos::subview(rate, range), 0.0);
  for (int dof : model_.released_before()) rate(dof) = 0;
}

double InitialRates::largest_velocity() const {
  const int u = model_.space().find("displacement");
  const NodalView rate = model_.store().committed().rate;
  double largest = 0;
  if (u >= 0)
    for (const auto& [begin, end] : overlap_ranges(*model_.space().dofs(), u))
      for (int i = begin; i < end; ++i) largest = std::max(largest, std::abs(rate(i)));
  return max_over_ranks(*model_.mesh().comm(), largest);
}

}  // namespace mudline
