// What becomes of a pass's history after a step: Uzawa's method, mesh motion, results.
#include <algorithm>
#include <cmath>

#include "contact/convection.hpp"
#include "contact/node_pass.hpp"

namespace mudline {

namespace column = node_column;

bool NodePass::sticks(const State& state, int row) const {
  const PointView& points = state.arrays[points_];
  return settings_.friction && points(row, column::pressure) > 0 && points(row, column::slides) == 0;
}

std::optional<Augmentation> NodePass::update_active_set(const State& trial, const std::string& contact,
                                                        double gap_tolerance) const {
  const auto pressed = [&](int row) {
    if (!(rows_[row].area > 0)) return capture_;
    return trial.arrays[points_](row, column::gap) - trial.arrays[multipliers_](row, 0) / penalty(trial, row);
  };
  return active_set_.update(trial, contact, settings_.deck->active_set, gap_tolerance, pressed, *mesh_.comm());
}

Misfit NodePass::misfit(const State& state) const {
  const int nodes = mesh_.num_nodes();
  std::vector<double> normal(nodes, 0.0), shear(nodes, 0.0), lengths(nodes, 0.0), stiffnesses(nodes, 0.0);
  const PointView &points = state.arrays[points_], &multipliers = state.arrays[multipliers_];
  double spring = 0;
  for (int row = 0; row < static_cast<int>(rows_.size()); ++row) {
    const int node = rows_[row].node;
    const double length = rows_[row].length;
    spring = std::max(spring, points(row, column::pressure) / penalty(state, row));
    normal[node] += length * (points(row, column::pressure) - multipliers(row, 0));
    if (sticks(state, row)) shear[node] += length * (points(row, column::shear) - multipliers(row, 1));
    lengths[node] += length;
    stiffnesses[node] += length * penalty(state, row);
  }
  return {slave_,
          std::move(normal),
          std::move(shear),
          std::move(lengths),
          std::move(stiffnesses),
          settings_.friction ? settings_.friction->tangential_factor() : 0.0,
          spring};
}

void NodePass::augment(const State& trial) const {
  // as many multipliers as conditions: each takes the stress of its node
  const PointView &points = trial.arrays[points_], &multipliers = trial.arrays[multipliers_];
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    multipliers(row, 0) = points(row, column::pressure);
    multipliers(row, 1) = points(row, column::shear);
  }
}

void NodePass::relocate(const ConstCoordinateView& x_old, State& committed) const {
  std::size_t first = 0;
  for (const SurfaceSide& side : slave_.sides()) {
    const SideShifts shifts(side, x_old, committed.coordinates);
    for (const auto& [array, c] :
         {std::pair{points_, static_cast<int>(column::shear)}, std::pair{points_, static_cast<int>(column::slip)},
          std::pair{multipliers_, 0}, std::pair{multipliers_, 1}})
      shifts.convect(committed.arrays[array], static_cast<int>(first), c);
    for (int a = 0; a < side.count; ++a) {
      double& normal = committed.arrays[multipliers_](first + a, 0);
      normal = std::max(normal, 0.0);
    }
    first += side.count;
  }
}

void NodePass::adopt(const State& evaluated, State& committed) const {
  Kokkos::deep_copy(committed.arrays[points_], evaluated.arrays[points_]);
}

double NodePass::sum(const State& state, int c) const {
  double result = 0;
  for (std::size_t row = 0; row < rows_.size(); ++row) result += state.arrays[points_](row, c);
  return result;
}

double NodePass::damping_heat(const State& state) const { return damping_ < 0 ? 0.0 : state.arrays[damping_](0, 0); }

double NodePass::deepest(const State& state) const {
  double result = 0;
  for (std::size_t row = 0; row < rows_.size(); ++row)
    if (state.arrays[points_](row, column::pressure) > 0)
      result = std::max(result, -state.arrays[points_](row, column::gap));
  return result;
}

std::vector<double> NodePass::nodal_mean(const State& state, int c) const {
  std::vector<double> weighted(mesh_.num_nodes(), 0.0), weights(mesh_.num_nodes(), 0.0);
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    weighted[rows_[row].node] += rows_[row].length * state.arrays[points_](row, c);
    weights[rows_[row].node] += rows_[row].length;
  }
  return slave_.mean(std::move(weighted), std::move(weights));
}

double NodePass::least_gap(double capture, const ConstCoordinateView& x) const {
  double least = 0;
  for (const Row& row : rows_) {
    const PlanePoint at{x(row.node, 0), x(row.node, 1)};
    int piece = -1;
    NodeFoot foot;
    if (!surface_.find_foot(surface_.near(at, capture), at, row.facing, capture, x, piece, foot)) continue;
    NodeForce force;
    NodeCoordinates here{at, surface_.coordinates(piece, x)};
    node_force({}, surface_.pieces()[piece], foot, here, here, false, force);
    least = std::min(least, force.gap);
  }
  return least;
}

}  // namespace mudline
