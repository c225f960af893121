// What follows a solve of a step: the multipliers of the augmented Lagrangian by Uzawa's method.
#include <algorithm>

#include "contact/body/penalty_contact.hpp"
#include "tensor/vec.hpp"

namespace mudline {

void PenaltyContact::check_enforcement(const Section& section) const {
  deck_.check(section);
  if (!deck_.augmented()) return;
  if (deck_.impact == PenaltyParameters::Impact::conserving)
    section.fail(
        "conserving is for 'enforcement' = penalty: its shares are those of the penalty spring's energy, which "
        "multipliers "
        "do not have; allowed with augmented Lagrangian: automatic, interpolated",
        "impact");
}

Point PenaltyContact::initial_shear_multiplier(const State& committed, int row) const {
  // what slides or is off the body is not stretched; what sticks, by as much as its multiplier differs from its stress
  return rows_.sticks(committed, row) ? rows_.shear_multiplier(committed, row) : rows_.shear(committed, row).shear;
}

void PenaltyContact::start_multipliers(const StepView& view) const {
  if (!deck_.augmented() || !laws_.friction()) return;
  for (int row = 0; row < first_row_.back(); ++row)
    rows_.set_shear_multiplier(*view.trial, row, initial_shear_multiplier(*view.committed, row));
}

Misfit PenaltyContact::misfit(const State& state) const {
  MisfitSums sums(surface_->mesh(), rows_.shears());
  const auto& sides = surface_->sides();
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const ContactRule& r = rule(sides[s]);
    double here[max_contact_points];  // areas, without the circumference: nodes on the axis have weight too
    if (!contact_areas(r, side_coordinates(sides[s], state.coordinates), Geometry::plane_strain, here)) continue;
    const double stiffness = state.arrays[penalties_](s, 0);
    for (int c = 0; c < r.points; ++c) {
      const int row = first_row_[s] + c;
      sums.spring = std::max(sums.spring, rows_.pressure(state, row) / stiffness);
      const double normal = rows_.pressure(state, row) - rows_.normal_multiplier(state, row);
      const Point shear =
          rows_.sticks(state, row) ? rows_.shear(state, row).shear - rows_.shear_multiplier(state, row) : Point{};
      for (int a = 0; a < sides[s].count; ++a) {
        const double weight = r.shape(c, a) * here[c];
        sums.add(sides[s].node[a], weight, stiffness, weight * normal, weight * shear);
      }
    }
  }
  return {*surface_, std::move(sums), laws_.tangential_factor()};
}

Augmentation PenaltyContact::augment(const StepView& view, int count) {
  const State& trial = *view.trial;
  if (!deck_.augmented()) return {};
  const Misfit rest = misfit(trial);
  if (const auto end = end_of_augmentation(name_, deck_, gap_tolerance_, rest, count, *context_.space.mesh().comm()))
    return *end;
  const auto& sides = surface_->sides();
  const ShapeMass masses = [&](const std::vector<double>& values, std::vector<double>& product,
                               std::vector<double>& lengths) {
    for (std::size_t s = 0; s < sides.size(); ++s) {
      const ContactRule& r = rule(sides[s]);
      double here[max_contact_points];
      if (!contact_areas(r, side_coordinates(sides[s], trial.coordinates), Geometry::plane_strain, here)) continue;
      for (int c = 0; c < r.points; ++c) {
        double value = 0;
        for (int a = 0; a < r.nodes; ++a) value += r.shape(c, a) * values[sides[s].node[a]];
        for (int a = 0; a < r.nodes; ++a) {
          product[sides[s].node[a]] += r.shape(c, a) * here[c] * value;
          lengths[sides[s].node[a]] += r.shape(c, a) * here[c];
        }
      }
    }
  };
  const std::vector<double> normal = in_shapes(*surface_, rest.normal, masses);
  std::vector<std::vector<double>> tangential;
  for (const std::vector<double>& component : rest.shear) tangential.push_back(in_shapes(*surface_, component, masses));
  for (std::size_t s = 0; s < sides.size(); ++s)
    for (int row = first_row_[s]; row < first_row_[s + 1]; ++row) {
      const double* const shape = &rule(sides[s]).shape(row - first_row_[s], 0);
      for (int a = 0; a < sides[s].count; ++a)
        rows_.normal_multiplier(trial, row) += shape[a] * normal[sides[s].node[a]];
      if (!laws_.friction()) continue;
      const bool sticks = rows_.sticks(trial, row);
      Point shear = sticks ? rows_.shear_multiplier(trial, row) : rows_.shear(trial, row).shear;
      if (sticks)
        for (std::size_t i = 0; i < tangential.size(); ++i)
          for (int a = 0; a < sides[s].count; ++a) shear[i] += shape[a] * tangential[i][sides[s].node[a]];
      rows_.set_shear_multiplier(trial, row, shear);
    }
  return {true, ""};
}

}  // namespace mudline
