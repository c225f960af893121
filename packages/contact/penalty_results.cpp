// What a penalty contact reports.
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

#include "contact/penalty_contact.hpp"

namespace mudline {

namespace column = contact_column;

std::string PenaltyContact::hint(const StepView& view) const {
  if (view.inertia || touch_ == 0) return "";
  return "body '" + deck_.body + "' touches nothing in contact '" + name_ +
         "' and has no inertia in a quasi-static stage: hold it, or release it in a dynamic stage";
}

void PenaltyContact::histories(const StepView& view, std::map<std::string, double>& values) {
  const State& state = *view.committed;
  const PointView& rows = state.arrays[points_];
  const auto force = local_force(state);
  // reaction (2), area, active points, work; friction: force (2), heat, sliding points; the tip's reaction; damping:
  // heat, force (2)
  constexpr int sums = 13;
  const PointView& done = state.arrays[work_];
  double local[sums] = {-force[0], -force[1], 0, 0, done(0, 0), 0, 0, 0, 0, 0, done(0, 1), -done(0, 2), -done(0, 3)},
         sum[sums];
  double deepest = 0, deepest_everywhere = 0;
  for (int row = 0; row < first_row_.back(); ++row) {
    if (friction_) {
      const PointView& shear = state.arrays[frictions_];
      local[5] -= shear(row, friction_column::force_x);
      local[6] -= shear(row, friction_column::force_y);
      local[7] += shear(row, friction_column::dissipated);
      local[8] += shear(row, friction_column::slides);
    }
    if (rows(row, column::active) == 0) continue;
    if (rows(row, column::height) < body_->tip_height()) local[9] -= rows(row, column::force_y);
    local[2] += rows(row, column::area);
    local[3] += 1;
    deepest = std::max(deepest, -rows(row, column::gap));
  }
  const Teuchos::Comm<int>& comm = *context_.space.mesh().comm();
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, sums, local, sum);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, deepest, Teuchos::outArg(deepest_everywhere));
  values[name() + "/reaction x [N]"] = sum[0];
  values[name() + "/reaction y [N]"] = sum[1];
  values[name() + "/tip reaction y [N]"] = sum[9];
  values[name() + "/shaft reaction y [N]"] = sum[1] - sum[9];
  values[name() + "/contact area [m2]"] = sum[2];
  values[name() + "/active points"] = sum[3];
  values[name() + "/maximum penetration [m]"] = deepest_everywhere;
  values[name() + "/work [J]"] = sum[4];
  if (deck_.damping > 0) {
    values[name() + "/damping heat [J]"] = sum[10];
    values[name() + "/damping x [N]"] = sum[11];
    values[name() + "/damping y [N]"] = sum[12];
  }
  if (deck_.augmented()) {
    const auto [gap, stretch, spring] = misfit(state).largest(comm);
    values[name() + "/weighted gap [m]"] = gap;
    if (friction_) values[name() + "/stretch [m]"] = stretch;
  }
  if (!friction_) return;
  values[name() + "/friction x [N]"] = sum[5];
  values[name() + "/friction y [N]"] = sum[6];
  values[name() + "/friction heat [J]"] = sum[7];
  values[name() + "/sliding points"] = sum[8];
}

std::vector<double> PenaltyContact::nodal_mean(const PointView& rows, int column) const {
  constexpr double node_xi[max_side_nodes] = {-1, 1, 0};
  const int nodes = context_.space.mesh().num_nodes();
  std::vector<double> weighted(nodes, 0.0), weights(nodes, 0.0);
  const auto& sides = surface_->sides();
  for (std::size_t s = 0; s < sides.size(); ++s)
    for (int a = 0; a < sides[s].count; ++a)
      for (int c = 0; c < rule(sides[s]).points; ++c) {
        // hat of half the side's length around the node: positive weights, unlike the quadratic shapes
        const double near = std::max(0.0, 1 - std::abs(rule(sides[s]).xi[c] - node_xi[a]));
        weighted[sides[s].node[a]] += near * rows(first_row_[s] + c, column);
        weights[sides[s].node[a]] += near;
      }
  return surface_->mean(std::move(weighted), std::move(weights));
}

std::vector<double> PenaltyContact::nodal_pressure(const State& state) const {
  return nodal_mean(state.arrays[points_], column::pressure);
}

std::vector<double> PenaltyContact::nodal_shear(const State& state) const {
  return friction_ ? nodal_mean(state.arrays[frictions_], friction_column::shear) : std::vector<double>();
}

}  // namespace mudline
