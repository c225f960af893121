#include "contact/body/penalty_contact.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

#include "contact/box_search.hpp"
#include "contact/conjugate_position.hpp"
#include "contact/convection.hpp"

namespace mudline {

namespace column = contact_column;

void PenaltyContact::declare_state(StateStore& store) {
  laws_.declare_state(store);
  body_->declare_state(store);
  const auto rows = surface_->row_ids([this](std::size_t s) { return first_row_[s + 1] - first_row_[s]; });
  const std::vector<StateVariable> columns = {{"gap", 1, "m"},     {"pressure", 1, "Pa"}, {"active", 1, "-"},
                                              {"force x", 1, "N"}, {"force y", 1, "N"},   {"area", 1, "m2"},
                                              {"height", 1, "m"},  {"moment", 1, "N m"}};
  points_ = declare_rows(store, name() + "/points", columns, rows);
  penalties_ = declare_rows(store, name() + "/penalty", {{"penalty", 1, "Pa/m"}},
                            surface_->row_ids([](std::size_t) { return 1; }));
  const std::vector<StateVariable> sums = {
      {"work", 1, "J"}, {"damping heat", 1, "J"}, {"damping x", 1, "N"}, {"damping y", 1, "N"}};
  work_ = declare_rows(store, name() + "/work", sums, {}, true);
  if (deck_.augmented())
    multipliers_ = declare_rows(store, name() + "/multipliers", {{"normal", 1, "Pa"}, {"shear", 1, "Pa"}}, rows);
  if (deck_.active_set.outer()) active_set_.declare_state(store, name() + "/", rows);
  if (!laws_.friction()) return;
  const std::vector<StateVariable> shear_columns = {{"shear", 1, "Pa"}, {"slip", 1, "m"},    {"dissipated", 1, "J"},
                                                    {"slides", 1, "-"}, {"force x", 1, "N"}, {"force y", 1, "N"}};
  frictions_ = declare_rows(store, name() + "/friction", shear_columns, rows);
}

void PenaltyContact::sparsity(Assembler& assembler) {
  for (int count = 2; count <= 3; ++count) group_[count - 2] = assembler.add_group(surface_->dofs(count));
  if (leak_) leak_->sparsity(assembler);
}

void PenaltyContact::begin(const StepView& view) {
  deck_.start_penalties(*surface_, context_.stiffness, view.trial->arrays[penalties_]);
  start_multipliers(view);
  if (leak_) leak_->open(view.flow ? covered_sides(*view.committed) : std::vector<char>());
  const BodyPlacement from = body_->placement(*view.committed), to = body_->placement(*view.trial);
  // what a free body will do in the step is not known yet
  const double advance = body_->released() ? body_->speed(*view.committed, view.dt) * view.dt
                                           : std::hypot(to.centre[0] - from.centre[0], to.centre[1] - from.centre[1]);
  capture_ = deck_.capture_distance > 0 ? deck_.capture_distance : 2 * surface_->longest(view.x_old) + advance;
  for (std::size_t s = 0; s < candidate_.size(); ++s) candidate_[s] = least_gap(s, view.x_old, to) <= capture_;
  if (active_set_.used()) start_active_set(view, to);
}

double PenaltyContact::least_gap(std::size_t side, const ConstCoordinateView& coordinates_now,
                                 const BodyPlacement& placement) const {
  const SurfaceSide& at = surface_->sides()[side];
  const auto [low, high] = side_box(at.node, at.count, coordinates_now);
  const PlanePoint centre{0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])};
  return body_->closest(placement, centre).gap - 0.5 * std::hypot(high[0] - low[0], high[1] - low[1]);
}

void PenaltyContact::write_points(const State& trial, std::size_t side, const std::vector<ContactPoint>& points) const {
  const PointView& rows = trial.arrays[points_];
  for (int row = first_row_[side]; row < first_row_[side + 1]; ++row) {
    const ContactPoint& point = points[row - first_row_[side]];
    rows(row, column::gap) = point.gap;
    rows(row, column::pressure) = point.pressure;
    rows(row, column::active) = point.active;
    rows(row, column::force_x) = point.force[0];
    rows(row, column::force_y) = point.force[1];
    rows(row, column::area) = point.area;
    rows(row, column::height) = point.height;
    rows(row, column::moment) = point.moment;
    if (!laws_.friction()) continue;
    const PointView& shear = trial.arrays[frictions_];
    shear(row, friction_column::shear) = point.shear.shear;
    shear(row, friction_column::slip) = point.shear.slip;
    shear(row, friction_column::dissipated) = point.shear.dissipated;
    shear(row, friction_column::slides) = point.shear.slides;
    shear(row, friction_column::force_x) = point.friction[0];
    shear(row, friction_column::force_y) = point.friction[1];
  }
}

ShearState PenaltyContact::shear_state(const State& state, int row) const {
  if (!laws_.friction()) return {};
  const PointView& rows = state.arrays[frictions_];
  return {rows(row, friction_column::shear), rows(row, friction_column::slip), rows(row, friction_column::dissipated),
          rows(row, friction_column::slides) > 0};
}

ContactStart PenaltyContact::point_start(const StepView& view, std::size_t side, int row) const {
  const State &committed = *view.committed, &trial = *view.trial;
  const PointView& rows = committed.arrays[points_];
  ContactStart start;
  start.shear = shear_state(committed, row);
  start.force = {rows(row, column::force_x), rows(row, column::force_y), rows(row, column::moment)};
  start.normal_force = rows(row, column::pressure) * rows(row, column::area);
  start.soil = laws_.soil(committed, surface_->sides()[side], rule(surface_->sides()[side]).xi[row - first_row_[side]]);
  start.member = active_set_.used() && active_set_.holds(trial, row);
  if (!deck_.augmented()) return start;
  const double penalty = trial.arrays[penalties_](side, 0);
  start.shift = trial.arrays[multipliers_](row, multiplier_column::normal) / penalty;
  start.shift_old = committed.arrays[multipliers_](row, multiplier_column::normal) / penalty;
  if (laws_.friction())
    start.shear.shear +=
        trial.arrays[multipliers_](row, multiplier_column::shear) - initial_shear_multiplier(committed, row);
  return start;
}

PenaltyContact::Positions PenaltyContact::positions(const StepView& view) const {
  if (!conserves(view))
    return {body_->placement(*view.committed), body_->placement(*view.trial), view.x_old, view.x_end};
  return {moved_ahead(*body_, *view.committed, view.impact.ahead_old, view.impact.lead),
          moved_ahead(*body_, *view.trial, view.impact.ahead_end, view.impact.lead),
          moved_ahead(context_.space, view.x_old, view.impact.ahead_old),
          moved_ahead(context_.space, view.x_end, view.impact.ahead_end)};
}

ContactPointLaw PenaltyContact::law(const StepView& view, std::size_t side) const {
  ContactPointLaw result = laws_.in_step(view, deck_.damping);
  result.penalty = view.trial->arrays[penalties_](side, 0);
  result.fixed = active_set_.used();
  result.first_guess = predicting_;
  result.conserves = conserves(view);
  return result;
}

bool PenaltyContact::evaluate(const StepView& view, const Positions& positions, std::size_t side, bool want_tangent,
                              SideForce& force, std::vector<ContactPoint>& points) const {
  const SurfaceSide& at = surface_->sides()[side];
  SideContact contact{rule(at),
                      *body_,
                      positions.body_old,
                      positions.body_end,
                      side_coordinates(at, positions.x_old),
                      side_coordinates(at, positions.x_end),
                      context_.space.mesh().geometry(),
                      law(view, side)};
  contact.reach = touch_;
  // how far away the touch is in terms of forces is not known: every guess moves the body ten times as far
  contact.reach_share = std::pow(0.1, view.linearisation);
  contact.pressure_nodes = surface_->pressure_nodes(at.count);
  for (int a = 0; a < contact.pressure_nodes; ++a)
    contact.pressure[a] = view.value_end(surface_->dofs(at.count)(at.row, 2 * at.count + a));
  for (int row = first_row_[side]; row < first_row_[side + 1]; ++row)
    contact.start[row - first_row_[side]] = point_start(view, side, row);
  return penalty_side(contact, want_tangent, force, points);
}

bool PenaltyContact::conserves(const StepView& view) const {
  if (!view.inertia || view.kind != StepView::Kind::step) return false;
  if (deck_.impact == PenaltyParameters::Impact::automatic)
    return !deck_.augmented() && !active_set_.used() && laws_.normal().linear() && body_->unknowns().count > 0;
  return deck_.impact == PenaltyParameters::Impact::conserving;
}

void PenaltyContact::book_damping(const State& trial, const std::vector<ContactPoint>& points) const {
  const PointView& sums = trial.arrays[work_];
  for (const ContactPoint& point : points) {
    sums(0, 1) += point.damped;
    for (int i = 0; i < 2; ++i) sums(0, 2 + i) += point.damping[i];
  }
}

void PenaltyContact::correction(const StepView& view, const ResidualView& f) {
  for (const auto& [dof, share] : correction_) f.add(dof, -share);
  if (leak_) leak_->add(view, f);
  if (laws_.friction() && temperature_ >= 0 && view.flow) add_heat(view, f);
}

void PenaltyContact::add_heat(const StepView& view, const ResidualView& f) const {
  const PointView &now = view.trial->arrays[frictions_], &old = view.committed->arrays[frictions_];
  const auto& dofs = context_.space.node_dof(temperature_);
  for (std::size_t s = 0; s < surface_->sides().size(); ++s) {
    const SurfaceSide& side = surface_->sides()[s];
    for (int row = first_row_[s]; row < first_row_[s + 1]; ++row) {
      const double power = (now(row, friction_column::dissipated) - old(row, friction_column::dissipated)) / view.dt;
      const double xi = rule(side).xi[row - first_row_[s]];
      f.add(dofs(side.node[0]), -0.5 * (1 - xi) * power);
      f.add(dofs(side.node[1]), -0.5 * (1 + xi) * power);
    }
  }
}

std::array<double, 3> PenaltyContact::local_force(const State& state) const {
  const PointView& rows = state.arrays[points_];
  std::array<double, 3> sum{};
  for (int row = 0; row < first_row_.back(); ++row) {
    sum[0] += rows(row, column::force_x);
    sum[1] += rows(row, column::force_y);
    sum[2] += rows(row, column::moment);
  }
  return sum;
}

int PenaltyContact::residual(const StepView& view, const ResidualView& f) {
  const auto& sides = surface_->sides();
  int failures = 0;
  correction_.clear();
  std::vector<ContactPoint> points;
  SideForce side_force;
  const Positions at = positions(view);
  const PointView& done = view.trial->arrays[work_];
  done(0, 1) = view.committed->arrays[work_](0, 1);
  done(0, 2) = done(0, 3) = 0;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (!candidate_[s]) {
      // the rows of a skipped side say that it is at least as far away as the search looked
      points.assign(rule(sides[s]).points, {});
      for (int row = first_row_[s]; row < first_row_[s + 1]; ++row) {
        ContactPoint& away = points[row - first_row_[s]];
        away.gap = capture_;
        away.shear = shear_state(*view.committed, row);
        away.shear.shear = 0;
        away.shear.slides = false;
      }
      write_points(*view.trial, s, points);
      continue;
    }
    if (!evaluate(view, at, s, false, side_force, points)) ++failures;
    write_points(*view.trial, s, points);
    if (damps(view)) book_damping(*view.trial, points);
    const ElementDofs& dofs = surface_->dofs(sides[s].count);
    const int soil = 2 * sides[s].count, all = static_cast<int>(dofs.extent(1));
    double pressing = 0;  // [m2]
    for (const ContactPoint& point : points) pressing += point.active ? point.area : 0;
    const double cancelled =
        view.trial->arrays[penalties_](s, 0) * pressing * farthest(side_coordinates(sides[s], at.x_end));
    for (int a = 0; a < all; ++a) {
      if (a >= soil && a < all - body_->unknowns().count) continue;  // the fluxes are none of contact's
      f.add(dofs(sides[s].row, a), -side_force.f[a]);
      f.cancelled(dofs(sides[s].row, a), cancelled);
      if (side_force.correction[a] != 0) correction_.emplace_back(dofs(sides[s].row, a), side_force.correction[a]);
    }
  }
  const auto before = local_force(*view.committed), now = local_force(*view.trial);
  const BodyPlacement from = body_->placement(*view.committed), to = body_->placement(*view.trial);
  done(0, 0) = view.committed->arrays[work_](0, 0);
  for (int i = 0; i < 2; ++i) done(0, 0) += 0.5 * (before[i] + now[i]) * (to.centre[i] - from.centre[i]);
  done(0, 0) += 0.5 * (before[2] + now[2]) * (to.angle - from.angle);
  look_for_touch(view);
  return failures;
}

void PenaltyContact::look_for_touch(const StepView& view) {
  touch_ = 0;
  if (view.inertia || !body_->released()) return;
  const PointView& rows = view.trial->arrays[points_];
  double nearest = 1e300, everywhere = 0;
  for (int row = 0; row < first_row_.back(); ++row)
    if (rows(row, column::area) > 0)
      nearest = std::min(nearest, rows(row, column::active) > 0 ? -1.0 : rows(row, column::gap));
  Teuchos::reduceAll(*context_.space.mesh().comm(), Teuchos::REDUCE_MIN, nearest, Teuchos::outArg(everywhere));
  if (everywhere >= 0 && everywhere < 1e300) touch_ = everywhere + 1e-3 * surface_->shortest(view.x_old);
}

void PenaltyContact::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const auto& sides = surface_->sides();
  const MatrixScatter to[2] = {assembler.scatter(group_[0]), assembler.scatter(group_[1])};
  std::vector<ContactPoint> points;
  SideForce force;
  const Positions at = positions(view);
  const double moved = conserves(view) ? view.impact.conjugate : 1.0;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const SurfaceSide& side = sides[s];
    if (!candidate_[s]) continue;
    evaluate(view, at, s, true, force, points);
    const int soil = 2 * side.count, first_body = soil + surface_->pressure_nodes(side.count);
    const int columns = first_body + body_->unknowns().count;
    for (int a = 0; a < columns; ++a) {
      if (a >= soil && a < first_body) continue;
      for (int b = 0; b < columns; ++b)
        to[side.count - 2].add(side.row, a, b, -weight * (b >= soil && b < first_body ? 1.0 : moved) * force.k[a][b]);
    }
  }
  if (leak_) leak_->jacobian(view, assembler);
}

bool PenaltyContact::covered(std::size_t side, const State& committed, const BodyPlacement& placement) const {
  // By distance: pressure alone would not do, since along a stretched side single points come off by micrometres, and a
  // vertex that is drained for a step loses its pore pressure.
  const SideCoordinates x = side_coordinates(surface_->sides()[side], committed.coordinates);
  const double near = deck_.sealing_gap * std::hypot(x[1][0] - x[0][0], x[1][1] - x[0][1]);
  if (least_gap(side, committed.coordinates, placement) >= near) return false;
  const ContactRule& points = rule(surface_->sides()[side]);
  int count = 0;
  for (int c = 0; c < points.points; ++c) count += body_->closest(placement, points.place(c, x)).gap < near;
  return 2 * count > points.points;
}

std::vector<char> PenaltyContact::covered_sides(const State& committed) const {
  const BodyPlacement placement = body_->placement(committed);
  std::vector<char> flags;
  for (std::size_t s = 0; s < surface_->sides().size(); ++s) flags.push_back(covered(s, committed, placement));
  return flags;
}

void PenaltyContact::close(const State& committed, ClosedSides& closed) const {
  if (deck_.drainage == PenaltyParameters::Drainage::drained || pressure_ < 0) return;
  closed.possible = true;
  const std::vector<Side>& sides = surface_->mesh().side_sets().at(deck_.surface);
  const std::vector<char> flags = covered_sides(committed);
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (flags[s]) closed.sides.insert({sides[s].block, sides[s].element, sides[s].side});
}

double PenaltyContact::step_limit(const State& committed, double dt) const {
  const double edge = surface_->shortest(committed.coordinates);
  const double speed = body_->speed(committed, dt);
  const BodyPlacement placement = body_->placement(committed);
  double nearest = 1e300, everywhere = 0;
  for (std::size_t s = 0; s < candidate_.size(); ++s)
    nearest = std::min(nearest, least_gap(s, committed.coordinates, placement));
  Teuchos::reduceAll(*context_.space.mesh().comm(), Teuchos::REDUCE_MIN, nearest, Teuchos::outArg(everywhere));
  // a body that is still far away may come half the way
  return speed > 0 ? std::max(deck_.advance_limit * edge, 0.5 * everywhere) / speed : 1e300;
}

std::string PenaltyContact::hint(const StepView& view) const {
  if (view.inertia || touch_ == 0) return "";
  return "body '" + deck_.body + "' touches nothing in contact '" + name_ +
         "' and has no inertia in a quasi-static stage: hold it, or release it in a dynamic stage";
}

void PenaltyContact::histories(const StepView& view, Report& values) {
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
    if (laws_.friction()) {
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
  values[name() + "/reaction x"] = {"N", sum[0]};
  values[name() + "/reaction y"] = {"N", sum[1]};
  values[name() + "/tip reaction y"] = {"N", sum[9]};
  values[name() + "/shaft reaction y"] = {"N", sum[1] - sum[9]};
  values[name() + "/contact area"] = {"m2", sum[2]};
  values[name() + "/active points"] = {"-", sum[3]};
  values[name() + "/maximum penetration"] = {"m", deepest_everywhere};
  values[name() + "/work"] = {"J", sum[4], true};
  if (deck_.damping > 0) {
    values[name() + "/damping heat"] = {"J", sum[10]};
    values[name() + "/damping x"] = {"N", sum[11]};
    values[name() + "/damping y"] = {"N", sum[12]};
  }
  if (deck_.augmented()) {
    const auto [gap, stretch, spring] = misfit(state).largest(comm);
    values[name() + "/weighted gap"] = {"m", gap};
    if (laws_.friction()) values[name() + "/stretch"] = {"m", stretch};
  }
  if (!laws_.friction()) return;
  values[name() + "/friction x"] = {"N", sum[5]};
  values[name() + "/friction y"] = {"N", sum[6]};
  values[name() + "/friction heat"] = {"J", sum[7]};
  values[name() + "/sliding points"] = {"-", sum[8]};
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
  return laws_.friction() ? nodal_mean(state.arrays[frictions_], friction_column::shear) : std::vector<double>();
}

void PenaltyContact::relocate(const ConstCoordinateView& x_old, State& committed) {
  // gaps and pressures are those of the new places, evaluated anew; the shear stress, the path slid and multipliers are
  // history and are convected along the side, f + (s_new - s_old) df/ds
  std::vector<std::pair<int, int>> convected;  // (array, column)
  if (laws_.friction()) convected = {{frictions_, friction_column::shear}, {frictions_, friction_column::slip}};
  if (deck_.augmented()) {
    convected.emplace_back(multipliers_, multiplier_column::normal);
    convected.emplace_back(multipliers_, multiplier_column::shear);
  }
  if (convected.empty()) return;
  const auto& sides = surface_->sides();
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const int points = first_row_[s + 1] - first_row_[s];
    const SideCoordinates before = side_coordinates(sides[s], x_old),
                          after = side_coordinates(sides[s], committed.coordinates);
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
  if (laws_.friction()) Kokkos::deep_copy(committed.arrays[frictions_], evaluated.arrays[frictions_]);
}

}  // namespace mudline
