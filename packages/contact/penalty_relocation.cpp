// What becomes of a penalty contact's history when the mesh is moved under it.
#include <algorithm>

#include "contact/convection.hpp"
#include "contact/penalty_contact.hpp"

namespace mudline {

void PenaltyContact::relocate(const ConstCoordinateView& x_old, State& committed) {
  // gaps and pressures are those of the new places, evaluated anew; the shear stress, the path slid and multipliers are
  // history and are convected along the side, f + (s_new - s_old) df/ds
  std::vector<std::pair<int, int>> convected;  // (array, column)
  if (friction_) convected = {{frictions_, friction_column::shear}, {frictions_, friction_column::slip}};
  if (deck_.augmented()) {
    convected.emplace_back(multipliers_, multiplier_column::normal);
    convected.emplace_back(multipliers_, multiplier_column::shear);
  }
  if (convected.empty()) return;
  const auto& sides = surface_->sides();
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const int points = first_row_[s + 1] - first_row_[s];
    const SideCoordinates before = coordinates(sides[s], x_old), after = coordinates(sides[s], committed.coordinates);
    std::vector<PlanePoint> from, to;
    for (int c = 0; c < points; ++c) {
      from.push_back(rule(sides[s]).place(c, before));
      to.push_back(rule(sides[s]).place(c, after));
    }
    const SideShifts shifts(from, to, {before[1][0] - before[0][0], before[1][1] - before[0][1]});
    for (const auto& [array, column] : convected) shifts.convect(committed.arrays[array], first_row_[s], column);
  }
  if (!deck_.augmented()) return;
  for (int row = 0; row < first_row_.back(); ++row) {
    double& normal = committed.arrays[multipliers_](row, multiplier_column::normal);
    normal = std::max(normal, 0.0);
  }
}

void PenaltyContact::adopt(const State& evaluated, State& committed) {
  Kokkos::deep_copy(committed.arrays[points_], evaluated.arrays[points_]);
  if (friction_) Kokkos::deep_copy(committed.arrays[frictions_], evaluated.arrays[frictions_]);
}

}  // namespace mudline
