// Uzawa's method of a pair, and what it reports.
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "contact/pair_contact.hpp"
#include "core/log.hpp"

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

PairContact::Misfit PairContact::misfit(const State& state) const {
  const int nodes = context_.space.mesh().num_nodes();
  Misfit result;
  std::vector<double> normal(nodes, 0.0), shear(nodes, 0.0), lengths(nodes, 0.0), stiffnesses(nodes, 0.0);
  for (std::size_t s = 0; s < slave_->sides().size(); ++s) {
    const auto whole = mass(static_cast<int>(s), state.coordinates);
    for (int a = 0; a < side_multipliers; ++a) {
      const int node = slave_->sides()[s].node[a], row = side_multipliers * static_cast<int>(s) + a;
      normal[node] += state.arrays[sides_](row, column::misfit);
      shear[node] += state.arrays[sides_](row, column::stretch);
      lengths[node] += whole[a][0] + whole[a][1];
      stiffnesses[node] += (whole[a][0] + whole[a][1]) * state.arrays[penalties_](s, 0);
    }
  }
  result.gap = slave_->mean(normal, stiffnesses);
  result.normal = slave_->mean(std::move(normal), lengths);
  if (!friction_) return result;
  result.stretch = slave_->mean(shear, std::move(stiffnesses));
  for (double& stretch : result.stretch) stretch /= friction_->tangential_factor();
  result.shear = slave_->mean(std::move(shear), std::move(lengths));
  return result;
}

std::array<double, 2> PairContact::largest(const Misfit& misfit) const {
  std::array<double, 2> here{}, everywhere{};
  for (double value : misfit.gap) here[0] = std::max(here[0], std::abs(value));
  for (double value : misfit.stretch) here[1] = std::max(here[1], std::abs(value));
  Teuchos::reduceAll(*context_.space.mesh().comm(), Teuchos::REDUCE_MAX, 2, here.data(), everywhere.data());
  return everywhere;
}

std::vector<double> PairContact::in_shapes(const std::vector<double>& weighted, const State& state) const {
  // the mass matrix over its lumped self has eigenvalues between 1/3 and 1
  constexpr int sweeps = 12;
  std::vector<double> result = weighted;
  for (int sweep = 1; sweep < sweeps; ++sweep) {
    std::vector<double> product(result.size(), 0.0), lengths(result.size(), 0.0);
    for (std::size_t s = 0; s < slave_->sides().size(); ++s) {
      const auto whole = mass(static_cast<int>(s), state.coordinates);
      const int* node = slave_->sides()[s].node;
      for (int a = 0; a < side_multipliers; ++a) {
        product[node[a]] += whole[a][0] * result[node[0]] + whole[a][1] * result[node[1]];
        lengths[node[a]] += whole[a][0] + whole[a][1];
      }
    }
    product = slave_->mean(std::move(product), std::move(lengths));
    for (std::size_t node = 0; node < result.size(); ++node) result[node] += weighted[node] - product[node];
  }
  return result;
}

Augmentation PairContact::augment(const StepView& view, int count) {
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
  const std::vector<double> normal = in_shapes(rest.normal, trial), shear = friction_ ? in_shapes(rest.shear, trial) : rest.shear;
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
  int here = beyond_reach_ ? 1 : 0, any = 0;
  Teuchos::reduceAll(*context_.space.mesh().comm(), Teuchos::REDUCE_MAX, here, Teuchos::outArg(any));
  if (any == 0) return "";
  return "surfaces of contact '" + name_ + "' met that were farther apart at the start than its 'reach': raise it";
}

void PairContact::histories(const StepView& view, std::map<std::string, double>& values) {
  const State& state = *view.committed;
  const PointView& rows = state.arrays[sides_];
  constexpr int sums = 5;
  double local[sums] = {0, 0, 0, 0, state.arrays[heat_](0, 0)}, sum[sums], deepest = 0, everywhere = 0;
  for (std::size_t row = 0; row < rows.extent(0); ++row) {
    local[0] += rows(row, column::force_x);
    local[1] += rows(row, column::force_y);
    local[2] += rows(row, column::area);
    local[3] += rows(row, column::slides);
    deepest = std::max(deepest, -rows(row, column::deepest));
  }
  const Teuchos::Comm<int>& comm = *context_.space.mesh().comm();
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, sums, local, sum);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, deepest, Teuchos::outArg(everywhere));
  values[name() + "/force on slave x [N]"] = sum[0];
  values[name() + "/force on slave y [N]"] = sum[1];
  values[name() + "/contact area [m2]"] = sum[2];
  values[name() + "/maximum penetration [m]"] = everywhere;
  const auto [gap, stretch] = largest(misfit(state));
  if (augmented()) values[name() + "/weighted gap [m]"] = gap;
  if (!friction_) return;
  if (augmented()) values[name() + "/stretch [m]"] = stretch;
  values[name() + "/sliding length [m]"] = sum[3];
  values[name() + "/friction heat [J]"] = sum[4];
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

std::vector<double> PairContact::nodal_pressure(const State& state) const { return nodal_mean(state, column::pressure); }

std::vector<double> PairContact::nodal_shear(const State& state) const {
  return friction_ ? nodal_mean(state, column::shear) : std::vector<double>();
}

}  // namespace mudline
