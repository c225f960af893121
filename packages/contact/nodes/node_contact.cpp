#include "contact/nodes/node_contact.hpp"

#include <algorithm>
#include <cmath>

#include "contact/convection.hpp"
#include "contact/laws/impact_share.hpp"
#include "core/pi.hpp"

namespace mudline {

namespace column = node_column;

namespace {
constexpr int quadrature_degree = 5;  // of tributary areas: exact on straight quadratic sides
}  // namespace

void NodeParameters::parameters(Parameters& p) {
  TwoSurfaceParameters::parameters(p);
  p.choice("master surface", drawing,
           {{"hermite", Drawing::hermite},
            {"bezier", Drawing::bezier},
            {"linear", Drawing::linear},
            {"sides", Drawing::sides}},
           "How the master is drawn over its nodes: hermite: smooth (C1) through them; bezier: smooth, from the middle "
           "between two nodes to the "
           "next, with the node as control point; linear: straight from node to node; sides: the elements' own sides, "
           "straight or parabolic");
  declare_corner_angle(p, corner_angle);
  p.add("overhang", overhang, "-", non_negative(),
        "An open end of the master goes on for this fraction of its last piece");
  declare_impact(p, impact);
}

void NodeContact::check(const Section& section) {
  const Mesh& mesh = context_.space.mesh();
  check_surfaces(section, 2);
  deck_.check(section);
  if (deck_.augmented() && section.has_parameter("impact"))
    section.fail("has a meaning only with 'enforcement' = penalty: its shares are those of the penalty spring's energy",
                 "impact");
  if ((deck_.drawing == Drawing::linear || deck_.drawing == Drawing::sides) &&
      section.has_parameter("corner angle [deg]"))
    section.fail("has a meaning only with a smooth 'master surface'; allowed with it: hermite, bezier",
                 "corner angle [deg]");
  read_laws_of_two(context_, section, laws_);
  laws_.check_linear(section, deck_.augmented(), deck_.impact == PairImpact::conserving);
  slave_ = std::make_unique<ContactSurface>(context_.space, deck_.slave, false, BodyUnknowns());
  master_ = std::make_unique<MasterSurface>(mesh, deck_.master);
  surface_ = std::make_unique<SmoothSurface>(master_->sides(), deck_.drawing, deck_.corner_angle * pi / 180,
                                             deck_.overhang, mesh.coordinates());
  for (CellShape side : {CellShape::line2, CellShape::line3})
    rules_.emplace_back(ContactPoints::nodes, side, quadrature_degree);
  for (std::size_t s = 0; s < slave_->sides().size(); ++s)
    for (int a = 0; a < slave_->sides()[s].count; ++a)
      rows_.push_back({static_cast<int>(s), slave_->sides()[s].node[a], a == 2 ? 0.0 : 2.0 * a - 1, 0, 0, {}, {}});
  measure(mesh.coordinates());
  capture_ = slave_->longest(mesh.coordinates());
  gap_tolerance_ = deck_.gap_tolerance > 0 ? deck_.gap_tolerance : 1e-6 * slave_->shortest(mesh.coordinates());
  check_overlap_of_two(*slave_, section, deck_.slave, least_gap(4 * capture_, mesh.coordinates()));
}

void NodeContact::declare_state(StateStore& store) {
  laws_.declare_state(store);
  const auto ids = slave_->row_ids([this](std::size_t s) { return slave_->sides()[s].count; });
  const std::vector<StateVariable> columns = {{"gap", 1, "m"},    {"pressure", 1, "Pa"}, {"shear", 1, "Pa"},
                                              {"slides", 1, "-"}, {"force x", 1, "N"},   {"force y", 1, "N"},
                                              {"area", 1, "m2"},  {"length", 1, "m"},    {"slip", 1, "m"},
                                              {"heat", 1, "J"},   {"piece", 1, "-"},     {"eta", 1, "-"}};
  points_ = declare_rows(store, name() + "/" + "points", columns, ids);
  penalties_ = declare_rows(store, name() + "/" + "penalty", {{"penalty", 1, "Pa/m"}},
                            slave_->row_ids([](std::size_t) { return 1; }));
  multipliers_ = declare_rows(store, name() + "/" + "multipliers", {{"normal", 1, "Pa"}, {"shear", 1, "Pa"}}, ids);
  if (deck_.damping > 0) damping_ = declare_rows(store, name() + "/" + "damping", {{"heat", 1, "J"}}, {}, true);
}

int NodeContact::place(int row, int piece) const {
  const auto found = place_of_.find(static_cast<long long>(row) << 32 | piece);
  return found == place_of_.end() ? -1 : found->second;
}

void NodeContact::sparsity(Assembler& assembler) {
  // every node and piece within reach have their matrix entries from the start: the graph, and with it the order of all
  // sums, never changes
  const auto& x = context_.space.mesh().coordinates();
  const Space& space = context_.space;
  const double distance = deck_.reach > 0 ? deck_.reach : 1e300;
  std::vector<std::pair<int, int>> places;
  for (std::size_t row = 0; row < rows_.size(); ++row)
    for (int piece : surface_->near({x(rows_[row].node, 0), x(rows_[row].node, 1)}, distance)) {
      place_of_[static_cast<long long>(row) << 32 | piece] = static_cast<int>(places.size());
      places.emplace_back(static_cast<int>(row), piece);
    }
  Kokkos::View<int**, Kokkos::LayoutRight> table("node to segment dofs", places.size(), node_dofs);
  for (std::size_t p = 0; p < places.size(); ++p) {
    int* to = space.write_dofs(displacement_, &rows_[places[p].first].node, 1, &table(p, 0));
    space.write_dofs(displacement_, surface_->pieces()[places[p].second].node, max_piece_nodes, to);
  }
  dofs_ = table;
  group_ = assembler.add_group(dofs_);
}

void NodeContact::measure(const ConstCoordinateView& x) {
  std::size_t row = 0;
  for (const SurfaceSide& side : slave_->sides()) {
    const ContactRule& rule = rules_[side.count - 2];
    const SideCoordinates at = side_coordinates(side, x);
    double areas[max_contact_points], lengths[max_contact_points];
    contact_areas(rule, at, context_.space.mesh().geometry(), areas);
    contact_areas(rule, at, Geometry::plane_strain, lengths);
    for (int a = 0; a < side.count; ++a, ++row) {
      rows_[row].area = areas[a];
      rows_[row].length = lengths[a];
      rows_[row].facing = {at[1][0] - at[0][0], at[1][1] - at[0][1]};
      // a corner of a quadratic side on the axis has no area: nothing can press there
      if (areas[a] < 1e-9 * lengths[a] * lengths[a]) rows_[row].area = 0;
    }
  }
}

void NodeContact::begin(const StepView& view) {
  surface_->update(view.x_old);
  measure(view.x_old);
  deck_.start_penalties(*slave_, context_.stiffness, view.trial->arrays[penalties_]);
  // the spring of friction starts unstretched from the stress that the step before left
  for (std::size_t row = 0; row < rows_.size(); ++row)
    view.trial->arrays[multipliers_](row, 1) = view.committed->arrays[points_](row, column::shear);
  const double longest = slave_->longest(view.x_old);
  capture_ = deck_.capture_distance > 0 ? deck_.capture_distance : longest;
  touch_ = 1e-9 * longest;
  for (Row& row : rows_)
    row.candidates = surface_->near({view.x_old(row.node, 0), view.x_old(row.node, 1)}, 2 * capture_);
}

bool NodeContact::look(int row, const ConstCoordinateView& x, Seen& seen) const {
  const Row& at = rows_[row];
  if (!(at.area > 0) || !surface_->find_projection(at.candidates, {x(at.node, 0), x(at.node, 1)}, at.facing, capture_,
                                                   x, seen.piece, seen.projection))
    return false;
  seen.place = place(row, seen.piece);
  return true;
}

NodeCoordinates NodeContact::coordinates(int row, int piece, const ConstCoordinateView& x) const {
  return {{x(rows_[row].node, 0), x(rows_[row].node, 1)}, surface_->coordinates(piece, x)};
}

NodeLaw NodeContact::law(const StepView& view, int row) const {
  const PointView &multipliers = view.trial->arrays[multipliers_], &old = view.committed->arrays[points_];
  NodeLaw result;
  static_cast<ContactPointLaw&>(result) = laws_.in_step(view, deck_.damping);
  result.penalty = penalty(*view.trial, row);
  result.touch = touch_;
  result.first_guess = predicting_;
  result.conserves = conserves(view);
  result.area = rows_[row].area;
  result.normal = multipliers(row, 0);
  result.shear = multipliers(row, 1);
  result.slip = old(row, column::slip);
  result.gap_old = old(row, column::gap);
  result.normal_old = old(row, column::pressure) * old(row, column::area);
  result.soil = laws_.soil(*view.committed, slave_->sides()[rows_[row].side], &rows_[row].xi);
  return result;
}

void NodeContact::write_away(const StepView& view, int row) const {
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

void NodeContact::old_force(const State& committed, int row, const SurfacePiece& piece,
                            double (&force)[node_dofs]) const {
  const PointView& old = committed.arrays[points_];
  double W[max_piece_nodes], dW[max_piece_nodes], ddW[max_piece_nodes];
  piece.weights(old(row, column::eta), W, dW, ddW);
  force[0] = old(row, column::force_x);
  force[1] = old(row, column::force_y);
  std::fill_n(force + 2, node_dofs - 2, 0.0);
  spread(piece.count, W, Vec<double, 2>{-force[0], -force[1]}, force + 2);
}

int NodeContact::residual(const StepView& view, const ResidualView& f) {
  correction_.clear();
  int failures = 0;
  const PointView &points = view.trial->arrays[points_], &old = view.committed->arrays[points_];
  NodeForce force;
  double damped = 0;
  const Positions at = positions(view);
  for (int row = 0; row < static_cast<int>(rows_.size()); ++row) {
    Seen seen;
    if (!look(row, at.end, seen)) {
      write_away(view, row);
      add_old_share(view, row, start_share(old(row, column::gap), capture_, view.impact.damping));
      continue;
    }
    const NodeLaw acting = law(view, row);
    const SurfacePiece& piece = surface_->pieces()[seen.piece];
    const NodeCoordinates now = coordinates(row, seen.piece, at.end);
    node_force(acting, piece, seen.projection, coordinates(row, seen.piece, at.old), now, false, force);
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
    points(row, column::eta) = seen.projection.eta;
  }
  if (damping_ >= 0) view.trial->arrays[damping_](0, 0) = view.committed->arrays[damping_](0, 0) + damped;
  beyond_reach_ = failures > 0;
  return failures;
}

void NodeContact::add_old_share(const StepView& view, int row, double share) {
  const PointView& old = view.committed->arrays[points_];
  if (!conserves(view) || !(old(row, column::pressure) > 0)) return;
  const int was = static_cast<int>(old(row, column::piece)), there = place(row, was);
  if (there < 0) return;
  double before[node_dofs];
  old_force(*view.committed, row, surface_->pieces()[was], before);
  const double more = share - (1 - view.end_weight);
  for (int a = 0; a < node_dofs; ++a) correction_.emplace_back(dofs_(there, a), more * before[a]);
}

void NodeContact::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const MatrixScatter to = assembler.scatter(group_);
  const PointView& old = view.committed->arrays[points_];
  const bool conserving = conserves(view);
  const double moved = conserving ? view.impact.conjugate : 1.0;
  NodeForce force;
  const Positions at = positions(view);
  for (int row = 0; row < static_cast<int>(rows_.size()); ++row) {
    Seen seen;
    if (!look(row, at.end, seen) || seen.place < 0) continue;
    const SurfacePiece& piece = surface_->pieces()[seen.piece];
    node_force(law(view, row), piece, seen.projection, coordinates(row, seen.piece, at.old),
               coordinates(row, seen.piece, at.end), true, force);
    if (force.presses || force.damped != 0)
      for (int a = 0; a < node_dofs; ++a)
        for (int b = 0; b < node_dofs; ++b) to.add(seen.place, a, b, -weight * moved * force.k[a][b]);
    // the matrix has no entries that couple the node with another piece, on which its old force acted
    if (!conserving || !(old(row, column::pressure) > 0) || static_cast<int>(old(row, column::piece)) != seen.piece)
      continue;
    double before[node_dofs];
    old_force(*view.committed, row, piece, before);
    for (int a = 0; a < node_dofs; ++a)
      for (int b = 0; b < node_dofs; ++b)
        to.add(seen.place, a, b, -weight * moved / view.end_weight * before[a] * force.start_share_slope[b]);
  }
}

bool NodeContact::sticks(const State& state, int row) const {
  const PointView& points = state.arrays[points_];
  return laws_.friction() && points(row, column::pressure) > 0 && points(row, column::slides) == 0;
}

Misfit NodeContact::misfit(const State& state) const {
  const PointView &points = state.arrays[points_], &multipliers = state.arrays[multipliers_];
  MisfitSums sums(context_.space.mesh());
  for (int row = 0; row < static_cast<int>(rows_.size()); ++row) {
    const double length = rows_[row].length, stiffness = penalty(state, row);
    sums.spring = std::max(sums.spring, points(row, column::pressure) / stiffness);
    sums.add(rows_[row].node, length, stiffness, length * (points(row, column::pressure) - multipliers(row, 0)),
             {sticks(state, row) ? length * (points(row, column::shear) - multipliers(row, 1)) : 0.0});
  }
  return {*slave_, std::move(sums), laws_.tangential_factor()};
}

Augmentation NodeContact::augment(const StepView& view, int count) {
  if (!deck_.augmented()) return {};
  const State& trial = *view.trial;
  const Comm& comm = *context_.space.mesh().comm();
  if (const auto end = end_of_augmentation(name_, deck_, gap_tolerance_, misfit(trial), count, comm)) return *end;
  // as many multipliers as conditions: each takes the stress of its node
  const PointView &points = trial.arrays[points_], &multipliers = trial.arrays[multipliers_];
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    multipliers(row, 0) = points(row, column::pressure);
    multipliers(row, 1) = points(row, column::shear);
  }
  return {true, ""};
}

void NodeContact::histories(const StepView& view, Report& values) {
  const State& state = *view.committed;
  const PointView& points = state.arrays[points_];
  SlaveSums here;
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    here.force[0] += points(row, column::force_x);
    here.force[1] += points(row, column::force_y);
    here.area += points(row, column::area);
    here.heat += points(row, column::heat);
    if (points(row, column::pressure) > 0) here.deepest = std::max(here.deepest, -points(row, column::gap));
  }
  if (damping_ >= 0) here.damped = state.arrays[damping_](0, 0);
  const Comm& comm = *context_.space.mesh().comm();
  const SlaveSums all = report_slave(comm, 2, name(), deck_, here, values);
  if (deck_.augmented()) {
    const auto [gap, stretch, spring] = misfit(state).largest(comm);
    values[name() + "/weighted gap"] = {"m", gap};
    if (laws_.friction()) values[name() + "/stretch"] = {"m", stretch};
  }
  if (laws_.friction()) values[name() + "/friction heat"] = {"J", all.heat};
}

double NodeContact::step_limit(const State& committed, double) const {
  return closing_limit(context_.space, *slave_, *master_, deck_.advance_limit, committed);
}

void NodeContact::relocate(const ConstCoordinateView& x_old, State& committed) {
  std::size_t first = 0;
  for (const SurfaceSide& side : slave_->sides()) {
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

void NodeContact::take_evaluated(const State& evaluated, State& committed) {
  Kokkos::deep_copy(committed.arrays[points_], evaluated.arrays[points_]);
}

std::vector<double> NodeContact::nodal_mean(const State& state, int c) const {
  std::vector<double> weighted(context_.space.mesh().num_nodes(), 0.0), weights(context_.space.mesh().num_nodes(), 0.0);
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    weighted[rows_[row].node] += rows_[row].length * state.arrays[points_](row, c);
    weights[rows_[row].node] += rows_[row].length;
  }
  return slave_->mean(std::move(weighted), std::move(weights));
}

std::vector<double> NodeContact::nodal_pressure(const State& state) const {
  return nodal_mean(state, column::pressure);
}

std::vector<double> NodeContact::nodal_shear(const State& state) const {
  return laws_.friction() ? nodal_mean(state, column::shear) : std::vector<double>();
}

double NodeContact::least_gap(double capture, const ConstCoordinateView& x) const {
  double least = 0;
  for (const Row& row : rows_) {
    const PlanePoint at{x(row.node, 0), x(row.node, 1)};
    int piece = -1;
    NodeProjection projection;
    if (!surface_->find_projection(surface_->near(at, capture), at, row.facing, capture, x, piece, projection))
      continue;
    least = std::min(least, node_gap(surface_->pieces()[piece], projection, {at, surface_->coordinates(piece, x)}));
  }
  return least;
}

}  // namespace mudline
