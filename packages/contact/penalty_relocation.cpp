// What becomes of a penalty contact's history when the mesh is moved under it.
#include <algorithm>
#include <cmath>

#include "contact/penalty_contact.hpp"

namespace mudline {

namespace {

/// Least squares slope of values over places.
double slope(const std::vector<double>& at, const std::vector<double>& values) {
  double mean_at = 0, mean = 0, top = 0, bottom = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    mean_at += at[i] / at.size();
    mean += values[i] / at.size();
  }
  for (std::size_t i = 0; i < at.size(); ++i) {
    top += (at[i] - mean_at) * (values[i] - mean);
    bottom += (at[i] - mean_at) * (at[i] - mean_at);
  }
  return bottom > 0 ? top / bottom : 0.0;
}

}  // namespace

void PenaltyContact::relocate(const ConstCoordinateView& x_old, State& committed) {
  // gaps and pressures are those of the new places, evaluated anew; the shear stress, the path slid and multipliers are
  // history and are convected along the side, f + (s_new - s_old) df/ds
  std::vector<std::pair<int, int>> convected;  // (array, column)
  if (friction_) convected = {{frictions_, friction_column::shear}, {frictions_, friction_column::slip}};
  if (augmented()) {
    convected.emplace_back(multipliers_, multiplier_column::normal);
    convected.emplace_back(multipliers_, multiplier_column::shear);
  }
  if (convected.empty()) return;
  const auto& sides = surface_->sides();
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const int points = first_row_[s + 1] - first_row_[s];
    const SideCoordinates before = coordinates(sides[s], x_old), after = coordinates(sides[s], committed.coordinates);
    const double length = std::hypot(before[1][0] - before[0][0], before[1][1] - before[0][1]);
    const PlanePoint along{(before[1][0] - before[0][0]) / length, (before[1][1] - before[0][1]) / length};
    std::vector<double> at(points), shift(points), values(points);
    for (int c = 0; c < points; ++c) {
      const PlanePoint from = rule(sides[s]).place(c, before), to = rule(sides[s]).place(c, after);
      at[c] = from[0] * along[0] + from[1] * along[1];
      shift[c] = (to[0] - from[0]) * along[0] + (to[1] - from[1]) * along[1];
    }
    for (const auto& [array, column] : convected) {
      const PointView& rows = committed.arrays[array];
      for (int c = 0; c < points; ++c) values[c] = rows(first_row_[s] + c, column);
      const double gradient = slope(at, values);
      for (int c = 0; c < points; ++c) rows(first_row_[s] + c, column) = values[c] + gradient * shift[c];
    }
  }
  if (!augmented()) return;
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
