#include "ale/point_rules.hpp"

#include "ale/conservation.hpp"
#include "ale/point_locator.hpp"

namespace mudline {

namespace {

/// Calls visit(row) for the rows of this rank's own elements.
template <class Visit>
void for_own_rows(const BlockPoints& at, Visit&& visit) {
  for (int e : at.mesh.own_elements(at.block.block))
    for (int q = 0; q < at.block.points; ++q)
      visit(static_cast<std::size_t>(at.mesh.first_row(e, at.block.points) + q));
}

}  // namespace

PointRules::PointRules(const std::vector<StateVariable>& variables) {
  for (const StateVariable& variable : variables) rules_.insert(rules_.end(), variable.components, variable.transfer);
}

std::vector<int> PointRules::of(Transfer rule) const {
  std::vector<int> columns;
  for (std::size_t c = 0; c < rules_.size(); ++c)
    if (rules_[c] == rule) columns.push_back(static_cast<int>(c));
  return columns;
}

void PointRules::to_densities(const BlockPoints& at, Geometry geometry, std::vector<double>& table,
                              std::vector<StateVariable>& variables) const {
  const std::vector<int> columns = of(Transfer::total);
  if (columns.empty()) return;
  const std::vector<double> volumes = point_volumes(at, geometry);
  for (std::size_t row = 0; row < volumes.size(); ++row)
    for (int c : columns) table[row * rules_.size() + c] /= volumes[row];
  for (StateVariable& variable : variables)
    if (variable.transfer == Transfer::total) variable.low = -1e300, variable.high = 1e300;
}

void PointRules::to_totals(const PointTransfer& t, Geometry geometry) const {
  const std::vector<int> columns = of(Transfer::total);
  if (columns.empty()) return;
  const std::vector<double> before = point_volumes(t.before, geometry), after = point_volumes(t.after, geometry);
  for (int c : columns) {
    const auto sum = [&](const BlockPoints& at, const std::vector<double>& densities,
                         const std::vector<double>& volumes) {
      long double all = 0;
      for_own_rows(at, [&](std::size_t row) { all += densities[row * rules_.size() + c] * volumes[row]; });
      return at.mesh.sum(all);
    };
    const double old = sum(t.before, t.old, before);
    double made = sum(t.after, t.now, after);
    if (made == 0 && old != 0) {
      for_own_rows(t.after, [&](std::size_t row) { t.now[row * rules_.size() + c] = 1; });
      made = sum(t.after, t.now, after);
    }
    for_own_rows(t.after, [&](std::size_t row) {
      double& value = t.now[row * rules_.size() + c];
      value *= (made != 0 ? old / made : 1.0) * after[row];
    });
  }
}

void PointRules::take_nearest(const PointTransfer& t) const {
  const std::vector<int> columns = of(Transfer::nearest);
  if (columns.empty()) return;
  const GhostedMesh& mesh = t.before.mesh;
  const SoilBlock& block = t.before.block;
  const PointLocator locator(mesh, t.before.x);
  const std::vector<int>& there = mesh.block_elements(block.block);
  if (there.empty()) return;
  int guess = there.front();
  for (int e : t.after.mesh.own_elements(t.after.block.block))
    for (int q = 0; q < t.after.block.points; ++q) {
      const Point place = t.after.place(e, q);
      guess = locator.find(place, t.moved() ? e : guess).element;
      int nearest = 0;
      double least = 1e300;
      for (int k = 0; k < block.points; ++k) {
        const double away = distance(place, t.before.place(guess, k));
        if (away >= least) continue;
        least = away;
        nearest = k;
      }
      const std::size_t row = t.after.mesh.first_row(e, t.after.block.points) + q,
                        from = mesh.first_row(guess, block.points) + nearest;
      for (int c : columns) t.now[row * rules_.size() + c] = t.old[from * rules_.size() + c];
    }
}

}  // namespace mudline
