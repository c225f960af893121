#include "contact/penalty_contact.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

namespace mudline {

namespace {

/// Columns of the array of points.
namespace column {
enum : int { gap, pressure, active, force_x, force_y, area };
}

}  // namespace

void PenaltyContact::declare_state(StateStore& store) {
  body_->declare_state(store);
  ArrayInfo points, penalties, work_info;
  points.name = name() + "/points";
  points.variables = {{"gap", 1, "m"},     {"pressure", 1, "Pa"}, {"active", 1, "-"},
                      {"force x", 1, "N"}, {"force y", 1, "N"},   {"area", 1, "m2"}};
  points_ = store.declare(std::move(points), first_row_.back());
  penalties.name = name() + "/penalty";
  penalties.variables = {{"penalty", 1, "Pa/m"}};
  penalties_ = store.declare(std::move(penalties), static_cast<int>(surface_->sides().size()));
  work_info.name = name() + "/work";
  work_info.variables = {{"work", 1, "J"}};
  work_ = store.declare(std::move(work_info), 1);
}

void PenaltyContact::sparsity(Assembler& assembler) {
  for (int count = 2; count <= 3; ++count) group_[count - 2] = assembler.add_group(surface_->dofs(count));
}

SideCoordinates PenaltyContact::coordinates(const SurfaceSide& side, const ConstCoordinateView& x) const {
  SideCoordinates result{};
  for (int a = 0; a < side.count; ++a) result[a] = {x(side.node[a], 0), x(side.node[a], 1)};
  return result;
}

void PenaltyContact::set_penalties(const StepView& view) const {
  const PointView& rows = view.trial->arrays[penalties_];
  const auto& sides = surface_->sides();
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (rows(s, 0) > 0) continue;
    rows(s, 0) = deck_.penalty > 0
                     ? deck_.penalty
                     : deck_.penalty_factor * context_.stiffness(sides[s].block, sides[s].element) / sides[s].height;
  }
}

void PenaltyContact::begin(const StepView& view) {
  body_->advance(view);
  set_penalties(view);
  const auto from = body_->position(*view.committed), to = body_->position(*view.trial);
  const double advance = std::hypot(to[0] - from[0], to[1] - from[1]);
  capture_ = deck_.capture_distance > 0 ? deck_.capture_distance : 2 * surface_->longest(view.x_old) + advance;
  const auto& sides = surface_->sides();
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const SideCoordinates x = coordinates(sides[s], view.x_old);
    PlanePoint low = x[0], high = x[0];
    for (int a = 1; a < sides[s].count; ++a)
      for (int i = 0; i < 2; ++i) {
        low[i] = std::min(low[i], x[a][i]);
        high[i] = std::max(high[i], x[a][i]);
      }
    const PlanePoint centre{0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])};
    const double half_diagonal = 0.5 * std::hypot(high[0] - low[0], high[1] - low[1]);
    candidate_[s] = body_->closest(to, centre).gap <= capture_ + half_diagonal;
  }
}

void PenaltyContact::write_points(const PointView& rows, std::size_t side,
                                  const std::vector<ContactPoint>& points) const {
  for (int row = first_row_[side]; row < first_row_[side + 1]; ++row) {
    const ContactPoint& point = points[row - first_row_[side]];
    rows(row, column::gap) = point.gap;
    rows(row, column::pressure) = point.pressure;
    rows(row, column::active) = point.active;
    rows(row, column::force_x) = point.force[0];
    rows(row, column::force_y) = point.force[1];
    rows(row, column::area) = point.area;
  }
}

std::array<double, 2> PenaltyContact::local_force(const State& state) const {
  const PointView& rows = state.arrays[points_];
  std::array<double, 2> sum{};
  for (int row = 0; row < first_row_.back(); ++row) {
    sum[0] += rows(row, column::force_x);
    sum[1] += rows(row, column::force_y);
  }
  return sum;
}

int PenaltyContact::residual(const StepView& view, const ResidualView& f) {
  const auto position = body_->position(*view.trial);
  const PointView& rows = view.trial->arrays[points_];
  const PointView& penalty = view.trial->arrays[penalties_];
  const auto& sides = surface_->sides();
  int failures = 0;
  magnitude_ = 0;
  std::vector<ContactPoint> points;
  SideForce side_force;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const ContactRule& at = rule(sides[s]);
    if (!candidate_[s]) {
      // the rows of a skipped side say that it is at least as far away as the search looked
      points.assign(at.points, ContactPoint{capture_, 0, {0, 0}, 0, false});
      write_points(rows, s, points);
      continue;
    }
    if (!penalty_side(at, *body_, position, penalty(s, 0), coordinates(sides[s], view.x_end), axisymmetric_, false,
                      side_force, points))
      ++failures;
    write_points(rows, s, points);
    const ElementDofs& dofs = surface_->dofs(sides[s].count);
    for (int a = 0; a < 2 * sides[s].count; ++a) {
      f(dofs(sides[s].row, a)) -= side_force.f[a];
      magnitude_ += side_force.f[a] * side_force.f[a];
    }
  }
  const auto before = local_force(*view.committed), now = local_force(*view.trial);
  const auto u_old = body_->displacement(*view.committed), u_new = body_->displacement(*view.trial);
  double done = view.committed->arrays[work_](0, 0);
  for (int i = 0; i < 2; ++i) done += 0.5 * (before[i] + now[i]) * (u_new[i] - u_old[i]);
  view.trial->arrays[work_](0, 0) = done;
  return failures;
}

void PenaltyContact::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const auto position = body_->position(*view.trial);
  const PointView& penalty = view.trial->arrays[penalties_];
  const auto& sides = surface_->sides();
  const MatrixScatter to[2] = {assembler.scatter(group_[0]), assembler.scatter(group_[1])};
  std::vector<ContactPoint> points;
  SideForce force;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const SurfaceSide& side = sides[s];
    if (!candidate_[s]) continue;
    penalty_side(rule(side), *body_, position, penalty(s, 0), coordinates(side, view.x_end), axisymmetric_, true, force,
                 points);
    for (int a = 0; a < 2 * side.count; ++a)
      for (int b = 0; b < 2 * side.count; ++b) to[side.count - 2].add(side.row, a, b, -weight * force.k[a][b]);
  }
}

bool PenaltyContact::closed(const PointView& rows, std::size_t side, double length) const {
  // Points that were not evaluated (no area) are far away. Pressure alone would not do: along a stretched side single
  // points come off by micrometres, and a vertex that is drained for a step loses its pore pressure.
  int count = 0;
  for (int row = first_row_[side]; row < first_row_[side + 1]; ++row)
    count += rows(row, column::area) > 0 && rows(row, column::gap) < deck_.sealing_gap * length;
  return 2 * count > first_row_[side + 1] - first_row_[side];
}

void PenaltyContact::constrain(const StepView& view, Constraints& constraints) {
  // without flow the pore pressure is given everywhere: releasing it would leave its equation empty
  if (deck_.drainage == PenaltyParameters::Drainage::drained || pressure_ < 0 || !view.flow) return;
  const PointView& rows = view.committed->arrays[points_];
  std::vector<char> flags(surface_->sides().size());
  for (std::size_t s = 0; s < flags.size(); ++s) {
    const SideCoordinates x = coordinates(surface_->sides()[s], view.x_old);
    flags[s] = closed(rows, s, std::hypot(x[1][0] - x[0][0], x[1][1] - x[0][1]));
  }
  const std::vector<char> sealed = surface_->enclosed(flags);
  const auto& dof = context_.space.node_dof(pressure_);
  for (std::size_t node = 0; node < sealed.size(); ++node)
    if (sealed[node] && dof(node) >= 0) constraints.mask(dof(node)) = 0;
}

void PenaltyContact::histories(const StepView& view, std::map<std::string, double>& values) {
  const State& state = *view.committed;
  const PointView& rows = state.arrays[points_];
  const auto force = local_force(state);
  double local[5] = {-force[0], -force[1], 0, 0, state.arrays[work_](0, 0)}, sum[5];
  double deepest = 0, deepest_everywhere = 0;
  for (int row = 0; row < first_row_.back(); ++row) {
    if (rows(row, column::active) == 0) continue;
    local[2] += rows(row, column::area);
    local[3] += 1;
    deepest = std::max(deepest, -rows(row, column::gap));
  }
  const Teuchos::Comm<int>& comm = *context_.space.mesh().comm();
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 5, local, sum);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, deepest, Teuchos::outArg(deepest_everywhere));
  values[name() + "/reaction x [N]"] = sum[0];
  values[name() + "/reaction y [N]"] = sum[1];
  values[name() + "/contact area [m2]"] = sum[2];
  values[name() + "/active points"] = sum[3];
  values[name() + "/maximum penetration [m]"] = deepest_everywhere;
  values[name() + "/work [J]"] = sum[4];
}

double PenaltyContact::step_limit(const State& committed, double dt) const {
  const double edge = surface_->shortest(committed.coordinates);
  const double speed = body_->speed(committed, dt);
  return speed > 0 ? deck_.advance_limit * edge / speed : 1e300;
}

std::vector<double> PenaltyContact::nodal_pressure(const State& state) const {
  constexpr double node_xi[max_side_nodes] = {-1, 1, 0};
  const int nodes = context_.space.mesh().num_nodes();
  std::vector<double> weighted(nodes, 0.0), weights(nodes, 0.0);
  const PointView& rows = state.arrays[points_];
  const auto& sides = surface_->sides();
  for (std::size_t s = 0; s < sides.size(); ++s)
    for (int a = 0; a < sides[s].count; ++a)
      for (int c = 0; c < rule(sides[s]).points; ++c) {
        // hat of half the side's length around the node: positive weights, unlike the quadratic shapes
        const double near = std::max(0.0, 1 - std::abs(rule(sides[s]).xi[c] - node_xi[a]));
        weighted[sides[s].node[a]] += near * rows(first_row_[s] + c, column::pressure);
        weights[sides[s].node[a]] += near;
      }
  return surface_->mean(std::move(weighted), std::move(weights));
}

}  // namespace mudline
