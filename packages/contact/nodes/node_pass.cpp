#include "contact/nodes/node_pass.hpp"

#include <algorithm>
#include <cmath>

#include "contact/conjugate_position.hpp"
#include "contact/convection.hpp"
#include "contact/laws/impact_share.hpp"
#include "core/pi.hpp"

namespace mudline {

namespace column = node_column;

namespace {
constexpr int quadrature_degree = 5;  // of tributary areas: exact on parabolic sides that are straight
}  // namespace

NodePass::NodePass(const NodePassSettings& settings, const std::string& slave, const std::string& master)
    : settings_(settings),
      mesh_(settings.context->space.mesh()),
      slave_(settings.context->space, slave, false, BodyUnknowns()),
      sides_(mesh_, master),
      surface_(sides_.sides(), settings.deck->drawing, settings.deck->corner_angle * pi / 180, settings.deck->overhang,
               mesh_.coordinates()),
      displacement_(settings.context->space.find("displacement")) {
  for (CellShape side : {CellShape::line2, CellShape::line3})
    rules_.emplace_back(ContactPoints::nodes, side, quadrature_degree);
  for (std::size_t s = 0; s < slave_.sides().size(); ++s)
    for (int a = 0; a < slave_.sides()[s].count; ++a)
      rows_.push_back({static_cast<int>(s), slave_.sides()[s].node[a], a == 2 ? 0.0 : 2.0 * a - 1, 0, 0, {}, {}});
  measure(mesh_.coordinates());
  capture_ = slave_.longest(mesh_.coordinates());
}

void NodePass::declare_state(StateStore& store) {
  const auto ids = slave_.row_ids([this](std::size_t s) { return slave_.sides()[s].count; });
  const std::vector<StateVariable> columns = {{"gap", 1, "m"},    {"pressure", 1, "Pa"}, {"shear", 1, "Pa"},
                                              {"slides", 1, "-"}, {"force x", 1, "N"},   {"force y", 1, "N"},
                                              {"area", 1, "m2"},  {"length", 1, "m"},    {"slip", 1, "m"},
                                              {"heat", 1, "J"},   {"piece", 1, "-"},     {"eta", 1, "-"}};
  points_ = declare_rows(store, settings_.prefix + "points", columns, ids);
  penalties_ = declare_rows(store, settings_.prefix + "penalty", {{"penalty", 1, "Pa/m"}},
                            slave_.row_ids([](std::size_t) { return 1; }));
  multipliers_ = declare_rows(store, settings_.prefix + "multipliers", {{"normal", 1, "Pa"}, {"shear", 1, "Pa"}}, ids);
  if (settings_.deck->damping > 0)
    damping_ = declare_rows(store, settings_.prefix + "damping", {{"heat", 1, "J"}}, {}, true);
  if (settings_.deck->active_set.outer()) active_set_.declare_state(store, settings_.prefix, ids);
}

int NodePass::place(int row, int piece) const {
  const auto found = place_of_.find(static_cast<long long>(row) << 32 | piece);
  return found == place_of_.end() ? -1 : found->second;
}

void NodePass::sparsity(Assembler& assembler) {
  // every node and piece within reach have their place from the start: the graph, and with it the order of all sums,
  // never changes
  const auto& x = mesh_.coordinates();
  const Space& space = settings_.context->space;
  const double distance = settings_.deck->reach > 0 ? settings_.deck->reach : 1e300;
  std::vector<std::pair<int, int>> places;
  for (std::size_t row = 0; row < rows_.size(); ++row)
    for (int piece : surface_.near({x(rows_[row].node, 0), x(rows_[row].node, 1)}, distance)) {
      place_of_[static_cast<long long>(row) << 32 | piece] = static_cast<int>(places.size());
      places.emplace_back(static_cast<int>(row), piece);
    }
  Kokkos::View<int**, Kokkos::LayoutRight> table("node to segment dofs", places.size(), node_dofs);
  for (std::size_t p = 0; p < places.size(); ++p) {
    int* to = space.write_dofs(displacement_, &rows_[places[p].first].node, 1, &table(p, 0));
    space.write_dofs(displacement_, surface_.pieces()[places[p].second].node, max_piece_nodes, to);
  }
  dofs_ = table;
  group_ = assembler.add_group(dofs_);
}

void NodePass::measure(const ConstCoordinateView& x) {
  std::size_t row = 0;
  for (const SurfaceSide& side : slave_.sides()) {
    const ContactRule& rule = rules_[side.count - 2];
    const SideCoordinates at = side_coordinates(side, x);
    double areas[max_contact_points], lengths[max_contact_points];
    contact_areas(rule, at, mesh_.geometry(), areas);
    contact_areas(rule, at, Geometry::plane_strain, lengths);
    for (int a = 0; a < side.count; ++a, ++row) {
      rows_[row].area = settings_.share * areas[a];
      rows_[row].length = lengths[a];
      rows_[row].facing = {at[1][0] - at[0][0], at[1][1] - at[0][1]};
      // a corner of a quadratic side on the axis has no area: nothing can press there
      if (areas[a] < 1e-9 * lengths[a] * lengths[a]) rows_[row].area = 0;
    }
  }
}

void NodePass::begin(const StepView& view) {
  surface_.update(view.x_old);
  measure(view.x_old);
  settings_.deck->start_penalties(slave_, settings_.context->stiffness, view.trial->arrays[penalties_]);
  // the spring of friction starts unstretched from the stress that the step before left
  for (std::size_t row = 0; row < rows_.size(); ++row)
    view.trial->arrays[multipliers_](row, 1) = view.committed->arrays[points_](row, column::shear);
  const double longest = slave_.longest(view.x_old);
  capture_ = settings_.deck->capture_distance > 0 ? settings_.deck->capture_distance : longest;
  touch_ = 1e-9 * longest;
  for (Row& row : rows_)
    row.candidates = surface_.near({view.x_old(row.node, 0), view.x_old(row.node, 1)}, 2 * capture_);
  if (active_set_.used()) start_active_set(view);
}

void NodePass::start_active_set(const StepView& view) const {
  // what pressed, and what overlaps before the nodes have moved: prescribed ones alone are at their places
  std::vector<char> presses(rows_.size(), 0);
  for (int row = 0; row < static_cast<int>(rows_.size()); ++row) {
    presses[row] = view.committed->arrays[points_](row, column::pressure) > 0;
    Seen seen;
    if (presses[row] || !look(row, view.x_end, capture_, seen)) continue;
    presses[row] =
        node_gap(surface_.pieces()[seen.piece], seen.foot, coordinates(row, seen.piece, view.x_end)) <= touch_;
  }
  active_set_.start(*view.trial, [&](int row) { return presses[row] != 0; });
}

bool NodePass::look(int row, const ConstCoordinateView& x, double capture, Seen& seen) const {
  const Row& at = rows_[row];
  if (!(at.area > 0) ||
      !surface_.find_foot(at.candidates, {x(at.node, 0), x(at.node, 1)}, at.facing, capture, x, seen.piece, seen.foot))
    return false;
  seen.place = place(row, seen.piece);
  return true;
}

NodeCoordinates NodePass::coordinates(int row, int piece, const ConstCoordinateView& x) const {
  return {{x(rows_[row].node, 0), x(rows_[row].node, 1)}, surface_.coordinates(piece, x)};
}

bool NodePass::conserves(const StepView& view) const {
  return view.inertia && view.kind == StepView::Kind::step && !settings_.deck->augmented() && !active_set_.used() &&
         settings_.deck->impact == PairImpact::conserving;
}

NodePass::Positions NodePass::positions(const StepView& view) const {
  if (!conserves(view)) return {view.x_old, view.x_end};
  const Space& space = settings_.context->space;
  return {moved_ahead(space, view.x_old, view.impact.ahead_old), moved_ahead(space, view.x_end, view.impact.ahead_end)};
}

NodeLaw NodePass::law(const StepView& view, int row) const {
  const PointView &multipliers = view.trial->arrays[multipliers_], &old = view.committed->arrays[points_];
  NodeLaw result;
  static_cast<ContactPointLaw&>(result) = settings_.laws->in_step(view, settings_.deck->damping);
  result.penalty = penalty(*view.trial, row);
  result.touch = touch_;
  result.fixed = active_set_.used();
  result.first_guess = predicting_;
  result.conserves = conserves(view);
  result.area = rows_[row].area;
  result.normal = multipliers(row, 0);
  result.shear = multipliers(row, 1);
  result.member = result.fixed && active_set_.holds(*view.trial, row);
  result.slip = old(row, column::slip);
  result.gap_old = old(row, column::gap);
  result.normal_old = old(row, column::pressure) * old(row, column::area);
  result.soil = settings_.laws->soil(*view.committed, slave_.sides()[rows_[row].side], &rows_[row].xi);
  return result;
}

void NodePass::write_away(const StepView& view, int row) const {
  const PointView &rows = view.trial->arrays[points_], &old = view.committed->arrays[points_];
  for (int c :
       {column::pressure, column::shear, column::slides, column::force_x, column::force_y, column::area, column::eta})
    rows(row, c) = 0;
  rows(row, column::gap) = capture_;
  rows(row, column::length) = rows_[row].length;
  rows(row, column::slip) = old(row, column::slip);
  rows(row, column::heat) = old(row, column::heat);
  rows(row, column::piece) = -1;
}

void NodePass::old_force(const State& committed, int row, const SurfacePiece& piece, double (&force)[node_dofs]) const {
  const PointView& old = committed.arrays[points_];
  double W[max_piece_nodes], dW[max_piece_nodes], ddW[max_piece_nodes];
  piece.weights(old(row, column::eta), W, dW, ddW);
  force[0] = old(row, column::force_x);
  force[1] = old(row, column::force_y);
  std::fill_n(force + 2, node_dofs - 2, 0.0);
  spread(piece.count, W, PlaneVector<double>{-force[0], -force[1]}, force + 2);
}

int NodePass::residual(const StepView& view, const ResidualView& f) {
  correction_.clear();
  int failures = 0;
  const PointView &points = view.trial->arrays[points_], &old = view.committed->arrays[points_];
  NodeForce force;
  double damped = 0;
  const Positions at = positions(view);
  for (int row = 0; row < static_cast<int>(rows_.size()); ++row) {
    Seen seen;
    if (!look(row, at.end, capture_, seen)) {
      write_away(view, row);
      add_old_share(view, row, start_share(old(row, column::gap), capture_, view.impact.damping));
      continue;
    }
    const NodeLaw acting = law(view, row);
    const SurfacePiece& piece = surface_.pieces()[seen.piece];
    const NodeCoordinates now = coordinates(row, seen.piece, at.end);
    node_force(acting, piece, seen.foot, coordinates(row, seen.piece, at.old), now, false, force);
    if (force.presses && seen.place < 0) ++failures;
    const double before = force.start_share;
    if (seen.place < 0) force = {};
    if (force.presses)
      for (int a = 0; a < node_dofs; ++a) {
        const int dof = dofs_(seen.place, a);
        f.add(dof, -force.f[a]);
        f.cancelled(dof, acting.penalty * acting.area * std::hypot(now.slave[0], now.slave[1]));
        if (force.share != 1) correction_.emplace_back(dof, view.end_weight * (force.share - 1) * force.f[a]);
      }
    add_old_share(view, row, before);
    if (force.damped != 0)
      for (int a = 0; a < node_dofs; ++a) correction_.emplace_back(dofs_(seen.place, a), force.damping[a]);
    damped += force.damped;
    points(row, column::gap) = force.gap;
    points(row, column::pressure) = force.pressure;
    points(row, column::shear) = force.shear;
    points(row, column::slides) = force.slides;
    points(row, column::force_x) = force.f[0];
    points(row, column::force_y) = force.f[1];
    points(row, column::area) = force.pressure > 0 ? acting.area : 0.0;
    points(row, column::length) = rows_[row].length;
    points(row, column::slip) = old(row, column::slip) + force.slip;
    points(row, column::heat) = old(row, column::heat) + force.heat;
    points(row, column::piece) = seen.piece;
    points(row, column::eta) = seen.foot.eta;
  }
  if (damping_ >= 0) view.trial->arrays[damping_](0, 0) = view.committed->arrays[damping_](0, 0) + damped;
  return failures;
}

void NodePass::add_old_share(const StepView& view, int row, double share) {
  const PointView& old = view.committed->arrays[points_];
  if (!conserves(view) || !(old(row, column::pressure) > 0)) return;
  const int was = static_cast<int>(old(row, column::piece)), there = place(row, was);
  if (there < 0) return;
  double before[node_dofs];
  old_force(*view.committed, row, surface_.pieces()[was], before);
  const double more = share - (1 - view.end_weight);
  for (int a = 0; a < node_dofs; ++a) correction_.emplace_back(dofs_(there, a), more * before[a]);
}

void NodePass::correction(const ResidualView& f) const {
  for (const auto& [dof, share] : correction_) f.add(dof, -share);
}

void NodePass::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const MatrixScatter to = assembler.scatter(group_);
  const PointView& old = view.committed->arrays[points_];
  const bool conserving = conserves(view);
  const double moved = conserving ? view.impact.conjugate : 1.0;
  NodeForce force;
  const Positions at = positions(view);
  for (int row = 0; row < static_cast<int>(rows_.size()); ++row) {
    Seen seen;
    if (!look(row, at.end, capture_, seen) || seen.place < 0) continue;
    const SurfacePiece& piece = surface_.pieces()[seen.piece];
    node_force(law(view, row), piece, seen.foot, coordinates(row, seen.piece, at.old),
               coordinates(row, seen.piece, at.end), true, force);
    if (force.presses || force.damped != 0)
      for (int a = 0; a < node_dofs; ++a)
        for (int b = 0; b < node_dofs; ++b) to.add(seen.place, a, b, -weight * moved * force.k[a][b]);
    // across two pieces the matrix has no place for the change of a leaving force
    if (!conserving || !(old(row, column::pressure) > 0) || static_cast<int>(old(row, column::piece)) != seen.piece)
      continue;
    double before[node_dofs];
    old_force(*view.committed, row, piece, before);
    for (int a = 0; a < node_dofs; ++a)
      for (int b = 0; b < node_dofs; ++b)
        to.add(seen.place, a, b, -weight * moved / view.end_weight * before[a] * force.start_share_slope[b]);
  }
}

bool NodePass::sticks(const State& state, int row) const {
  const PointView& points = state.arrays[points_];
  return settings_.laws->friction() && points(row, column::pressure) > 0 && points(row, column::slides) == 0;
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
  const PointView &points = state.arrays[points_], &multipliers = state.arrays[multipliers_];
  MisfitSums sums(mesh_);
  for (int row = 0; row < static_cast<int>(rows_.size()); ++row) {
    const double length = rows_[row].length, stiffness = penalty(state, row);
    sums.spring = std::max(sums.spring, points(row, column::pressure) / stiffness);
    sums.add(rows_[row].node, length, stiffness, length * (points(row, column::pressure) - multipliers(row, 0)),
             {sticks(state, row) ? length * (points(row, column::shear) - multipliers(row, 1)) : 0.0});
  }
  return {slave_, std::move(sums), settings_.laws->tangential_factor()};
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
    least = std::min(least, node_gap(surface_.pieces()[piece], foot, {at, surface_.coordinates(piece, x)}));
  }
  return least;
}

}  // namespace mudline
