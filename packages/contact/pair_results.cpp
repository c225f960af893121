// Uzawa's method of a pair, and what it reports.
#include <algorithm>
#include <cmath>

#include "contact/pair_contact.hpp"

namespace mudline {

namespace column = pair_column;

std::array<std::array<double, 2>, 2> PairContact::mass(int slave, const ConstCoordinateView& x) const {
  const SurfaceSide& side = slave_->sides()[slave];
  std::array<std::array<double, 2>, 2> result{};
  for (std::size_t q = 0; q < rule_.weights.size(); ++q) {
    const double xi = rule_.points[q][0], shape[2] = {0.5 * (1 - xi), 0.5 * (1 + xi)};
    double N[max_side_nodes], dN[max_side_nodes], along[2] = {0, 0};
    evaluate_line(nodes_, xi, N, dN);
    for (int a = 0; a < nodes_; ++a)
      for (int i = 0; i < 2; ++i) along[i] += dN[a] * x(side.node[a], i);
    const double length = rule_.weights[q] * std::hypot(along[0], along[1]);
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) result[a][b] += length * shape[a] * shape[b];
  }
  return result;
}

Misfit PairContact::misfit(const State& state) const {
  const int nodes = context_.space.mesh().num_nodes();
  std::vector<double> normal(nodes, 0.0), shear(nodes, 0.0), lengths(nodes, 0.0), stiffnesses(nodes, 0.0);
  double spring = 0;
  for (std::size_t s = 0; s < slave_->sides().size(); ++s) {
    const auto whole = mass(static_cast<int>(s), state.coordinates);
    for (int a = 0; a < side_multipliers; ++a) {
      const int node = slave_->sides()[s].node[a], row = side_multipliers * static_cast<int>(s) + a;
      normal[node] += state.arrays[sides_](row, column::misfit);
      shear[node] += state.arrays[sides_](row, column::stretch);
      lengths[node] += whole[a][0] + whole[a][1];
      stiffnesses[node] += (whole[a][0] + whole[a][1]) * state.arrays[penalties_](s, 0);
      spring = std::max(spring, state.arrays[sides_](row, column::pressure) / state.arrays[penalties_](s, 0));
    }
  }
  return {*slave_,
          std::move(normal),
          std::move(shear),
          std::move(lengths),
          std::move(stiffnesses),
          friction_ ? friction_->tangential_factor() : 0.0,
          spring};
}

Augmentation PairContact::augment(const StepView& view, int count) {
  if (!deck_.augmented()) return {};
  const State& trial = *view.trial;
  const Misfit rest = misfit(trial);
  if (const auto end = end_of_augmentation(name_, deck_, gap_tolerance_, rest, count, *context_.space.mesh().comm()))
    return *end;
  const ShapeMass masses = [&](const std::vector<double>& values, std::vector<double>& product,
                               std::vector<double>& lengths) {
    for (std::size_t s = 0; s < slave_->sides().size(); ++s) {
      const auto whole = mass(static_cast<int>(s), trial.coordinates);
      const int* node = slave_->sides()[s].node;
      for (int a = 0; a < side_multipliers; ++a) {
        product[node[a]] += whole[a][0] * values[node[0]] + whole[a][1] * values[node[1]];
        lengths[node[a]] += whole[a][0] + whole[a][1];
      }
    }
  };
  const std::vector<double> normal = in_shapes(*slave_, rest.normal, masses);
  const std::vector<double> shear = friction_ ? in_shapes(*slave_, rest.shear, masses) : rest.shear;
  const PointView& multipliers = trial.arrays[multipliers_];
  for (std::size_t s = 0; s < slave_->sides().size(); ++s)
    for (int a = 0; a < side_multipliers; ++a) {
      const int node = slave_->sides()[s].node[a];
      multipliers(side_multipliers * s + a, 0) += normal[node];
      if (friction_) multipliers(side_multipliers * s + a, 1) += shear[node];
    }
  return {true, ""};
}

std::string PairContact::hint(const StepView&) const {
  return beyond_reach_hint(*context_.space.mesh().comm(), name_, beyond_reach_);
}

void PairContact::histories(const StepView& view, std::map<std::string, double>& values) {
  const State& state = *view.committed;
  const PointView& rows = state.arrays[sides_];
  SlaveSums here;
  here.heat = state.arrays[heat_](0, 0);
  here.damped = state.arrays[heat_](0, 1);
  for (std::size_t row = 0; row < rows.extent(0); ++row) {
    here.force[0] += rows(row, column::force_x);
    here.force[1] += rows(row, column::force_y);
    here.area += rows(row, column::area);
    here.slides += rows(row, column::slides);
    here.deepest = std::max(here.deepest, -rows(row, column::deepest));
  }
  const Comm& comm = *context_.space.mesh().comm();
  const SlaveSums all = report_slave(comm, name(), deck_, here, values);
  const auto [gap, stretch, spring] = misfit(state).largest(comm);
  if (deck_.augmented()) values[name() + "/weighted gap [m]"] = gap;
  if (!friction_) return;
  if (deck_.augmented()) values[name() + "/stretch [m]"] = stretch;
  values[name() + "/sliding length [m]"] = all.slides;
  values[name() + "/friction heat [J]"] = all.heat;
}

std::vector<double> PairContact::nodal_mean(const State& state, int column) const {
  const int nodes = context_.space.mesh().num_nodes();
  std::vector<double> weighted(nodes, 0.0), weights(nodes, 0.0);
  for (std::size_t s = 0; s < slave_->sides().size(); ++s) {
    const SurfaceSide& side = slave_->sides()[s];
    for (int a = 0; a < side.count; ++a) {
      const PointView& rows = state.arrays[sides_];
      const int first = side_multipliers * static_cast<int>(s);
      weighted[side.node[a]] += a < 2 ? rows(first + a, column) : 0.5 * (rows(first, column) + rows(first + 1, column));
      weights[side.node[a]] += 1;
    }
  }
  return slave_->mean(std::move(weighted), std::move(weights));
}

std::vector<double> PairContact::nodal_pressure(const State& state) const {
  return nodal_mean(state, column::pressure);
}

std::vector<double> PairContact::nodal_shear(const State& state) const {
  return friction_ ? nodal_mean(state, column::shear) : std::vector<double>();
}

}  // namespace mudline
