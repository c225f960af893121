// Augmented Lagrangian: multipliers of a contact by Uzawa's method.
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "contact/penalty_contact.hpp"
#include "core/log.hpp"

namespace mudline {

namespace column = contact_column;

void PenaltyContact::check_enforcement(const Section& section) const {
  if (!augmented()) {
    for (const char* entry : {"gap tolerance", "most augmentations"})
      if (section.has_parameter(entry))
        section.fail("has a meaning only with 'enforcement' = augmented Lagrangian; here it is penalty", entry);
    return;
  }
  if (deck_.impact == PenaltyParameters::Impact::conserving)
    section.fail(
        "conserving is for 'enforcement' = penalty: its shares are those of the penalty spring's energy, which multipliers "
        "do not have; allowed with augmented Lagrangian: automatic, interpolated",
        "impact");
}

SideShift PenaltyContact::shifts(const StepView& view, std::size_t side) const {
  SideShift result;
  if (!augmented()) return result;
  const double penalty = view.trial->arrays[penalties_](side, 0);
  for (int row = first_row_[side]; row < first_row_[side + 1]; ++row) {
    result.now[row - first_row_[side]] = view.trial->arrays[multipliers_](row, multiplier_column::normal) / penalty;
    result.old[row - first_row_[side]] = view.committed->arrays[multipliers_](row, multiplier_column::normal) / penalty;
  }
  return result;
}

bool PenaltyContact::sticks(const State& state, int row) const {
  return friction_ && state.arrays[points_](row, column::active) > 0 && state.arrays[frictions_](row, friction_column::slides) == 0;
}

double PenaltyContact::initial_shear_multiplier(const State& committed, int row) const {
  // what slides or is off the body is not stretched; what sticks, by as much as its multiplier differs from its stress
  return sticks(committed, row) ? committed.arrays[multipliers_](row, multiplier_column::shear)
                                : committed.arrays[frictions_](row, friction_column::shear);
}

void PenaltyContact::start_multipliers(const StepView& view) const {
  if (!augmented() || !friction_) return;
  for (int row = 0; row < first_row_.back(); ++row)
    view.trial->arrays[multipliers_](row, multiplier_column::shear) = initial_shear_multiplier(*view.committed, row);
}

void PenaltyContact::add_multipliers(const StepView& view, std::size_t side, std::vector<ShearState>& old) const {
  if (!augmented()) return;
  const PointView& now = view.trial->arrays[multipliers_];
  for (int row = first_row_[side]; row < first_row_[side + 1]; ++row)
    old[row - first_row_[side]].shear += now(row, multiplier_column::shear) - initial_shear_multiplier(*view.committed, row);
}

PenaltyContact::Misfit PenaltyContact::misfit(const State& state) const {
  const int nodes = context_.space.mesh().num_nodes();
  const auto zeros = [&] { return std::vector<double>(nodes, 0.0); };
  Misfit sums{zeros(), zeros(), zeros(), zeros()};
  std::vector<double> lengths = zeros(), stiffnesses = zeros();
  const auto& sides = surface_->sides();
  const PointView &points = state.arrays[points_], &multipliers = state.arrays[multipliers_];
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const ContactRule& r = rule(sides[s]);
    SideAreas lengths_here;  // without the circumference: nodes on the axis have weight too
    if (!lengths_here.compute(r, coordinates(sides[s], state.coordinates), false)) continue;
    const double stiffness = state.arrays[penalties_](s, 0);
    for (int c = 0; c < r.points; ++c) {
      const int row = first_row_[s] + c;
      const double normal = points(row, column::pressure) - multipliers(row, multiplier_column::normal);
      const double shear = sticks(state, row) ? state.arrays[frictions_](row, friction_column::shear) -
                                                    multipliers(row, multiplier_column::shear)
                                              : 0.0;
      for (int a = 0; a < sides[s].count; ++a) {
        const int node = sides[s].node[a];
        const double weight = r.shape[c][a] * lengths_here.area[c];
        lengths[node] += weight;
        stiffnesses[node] += weight * stiffness;
        sums.normal[node] += weight * normal;
        sums.shear[node] += weight * shear;
      }
    }
  }
  sums.gap = surface_->mean(sums.normal, stiffnesses);
  sums.normal = surface_->mean(std::move(sums.normal), lengths);
  if (!friction_) return sums;
  sums.stretch = surface_->mean(sums.shear, std::move(stiffnesses));
  for (double& stretch : sums.stretch) stretch /= friction_->tangential_factor();
  sums.shear = surface_->mean(std::move(sums.shear), std::move(lengths));
  return sums;
}

std::vector<double> PenaltyContact::in_shapes(const std::vector<double>& weighted, const State& state) const {
  // the mass matrix of the sides' shapes over its lumped self has eigenvalues between 0.4 and 1 on quadratic sides
  constexpr int sweeps = 12;
  const auto& sides = surface_->sides();
  std::vector<double> result = weighted;
  for (int sweep = 1; sweep < sweeps; ++sweep) {
    std::vector<double> product(result.size(), 0.0), lengths(result.size(), 0.0);
    for (std::size_t s = 0; s < sides.size(); ++s) {
      const ContactRule& r = rule(sides[s]);
      SideAreas here;
      if (!here.compute(r, coordinates(sides[s], state.coordinates), false)) continue;
      for (int c = 0; c < r.points; ++c) {
        double value = 0;
        for (int a = 0; a < r.nodes; ++a) value += r.shape[c][a] * result[sides[s].node[a]];
        for (int a = 0; a < r.nodes; ++a) {
          product[sides[s].node[a]] += r.shape[c][a] * here.area[c] * value;
          lengths[sides[s].node[a]] += r.shape[c][a] * here.area[c];
        }
      }
    }
    product = surface_->mean(std::move(product), std::move(lengths));
    for (std::size_t node = 0; node < result.size(); ++node) result[node] += weighted[node] - product[node];
  }
  return result;
}

std::array<double, 2> PenaltyContact::largest(const Misfit& misfit) const {
  std::array<double, 2> here{}, everywhere{};
  for (double value : misfit.gap) here[0] = std::max(here[0], std::abs(value));
  for (double value : misfit.stretch) here[1] = std::max(here[1], std::abs(value));
  Teuchos::reduceAll(*context_.space.mesh().comm(), Teuchos::REDUCE_MAX, 2, here.data(), everywhere.data());
  return everywhere;
}

Augmentation PenaltyContact::augment(const StepView& view, int count) {
  if (!augmented()) return {};
  const State& trial = *view.trial;
  const Misfit rest = misfit(trial);
  const auto [gap, stretch] = largest(rest);
  char text[280];
  std::snprintf(text, sizeof text, "    %s: after %d augmentations weighted gap %.3g m, stretch %.3g m", name().c_str(), count, gap, stretch);
  log::detail(text);
  if (gap <= gap_tolerance_ && stretch <= gap_tolerance_) return {};
  if (count >= deck_.most_augmentations) {
    std::snprintf(text, sizeof text,
                  "contact '%s' misses its gap tolerance of %.3g m after %d augmentations: weighted gap %.3g m, stretch of what "
                  "sticks %.3g m (a larger penalty converges faster)",
                  name_.c_str(), gap_tolerance_, count, gap, stretch);
    return {false, text};
  }
  const auto& sides = surface_->sides();
  const std::vector<double> normal = in_shapes(rest.normal, trial), tangential = friction_ ? in_shapes(rest.shear, trial) : rest.shear;
  const PointView& multipliers = trial.arrays[multipliers_];
  for (std::size_t s = 0; s < sides.size(); ++s)
    for (int row = first_row_[s]; row < first_row_[s + 1]; ++row) {
      const auto& shape = rule(sides[s]).shape[row - first_row_[s]];
      for (int a = 0; a < sides[s].count; ++a) multipliers(row, multiplier_column::normal) += shape[a] * normal[sides[s].node[a]];
      if (!friction_) continue;
      double& shear = multipliers(row, multiplier_column::shear);
      if (sticks(trial, row))
        for (int a = 0; a < sides[s].count; ++a) shear += shape[a] * tangential[sides[s].node[a]];
      else
        shear = trial.arrays[frictions_](row, friction_column::shear);
    }
  return {true, ""};
}

}  // namespace mudline
