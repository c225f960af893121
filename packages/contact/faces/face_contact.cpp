#include "contact/faces/face_contact.hpp"

#include <algorithm>
#include <cmath>

#include "contact/convection.hpp"
#include "contact/laws/impact_share.hpp"
#include "core/pi.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace column = face_column;

namespace {

Point vector(const PointView& rows, int row, int first) {
  return {rows(row, first), rows(row, first + 1), rows(row, first + 2)};
}

void put(const PointView& rows, int row, int first, const Point& values) {
  for (int i = 0; i < 3; ++i) rows(row, first + i) = values[i];
}

}  // namespace

void FaceParameters::parameters(Parameters& p) {
  TwoSurfaceParameters::parameters(p);
  declare_corner_angle(p, corner_angle);
  p.add("quadrature degree", quadrature_degree, "-", closed(1, 8),
        "Polynomial degree up to which the forces on a slave side are integrated exactly; more points see the edges of "
        "the master's faces better");
  declare_impact(p, impact);
}

void FaceContact::check(const Section& section) {
  check_surfaces(section, 3);
  const Space& space = context_.space;
  const Mesh& mesh = space.mesh();
  if (deck_.augmented())
    section.fail("points have more multipliers than the surfaces have freedom; allowed with point to face: penalty",
                 "enforcement");
  deck_.check(section);
  read_laws_of_two(context_, section, laws_);
  laws_.check_linear(section, false, deck_.impact == PairImpact::conserving);
  slave_ = std::make_unique<ContactSurface>(space, deck_.slave, false, BodyUnknowns());
  master_ = std::make_unique<MasterFaces>(mesh, deck_.master, deck_.corner_angle * pi / 180);
  for (CellShape shape : slave_->shapes())
    rules_.emplace(shape, ContactRule(ContactPoints::quadrature, shape, deck_.quadrature_degree));
  const auto& sides = slave_->sides();
  for (std::size_t s = 0; s < sides.size(); ++s)
    for (int c = 0; c < rules_.at(sides[s].shape).points; ++c) rows_.push_back({static_cast<int>(s), c});
  const ConstCoordinateView x = mesh.coordinates();
  measure(x);
  const double longest = slave_->longest(x);
  if (deck_.reach == 0) deck_.reach = 3 * longest;
  capture_ = 4 * longest;
  candidates_.clear();
  for (const SurfaceSide& side : sides)
    candidates_.push_back(master_->near(side_box(side.node, side.count, x), capture_));
  double least = 0;
  Seen seen;
  for (int row = 0; row < static_cast<int>(rows_.size()); ++row)
    if (look(row, x, seen)) least = std::min(least, seen.projection.gap);
  check_overlap_of_two(*slave_, section, deck_.slave, least);
  capture_ = deck_.capture_distance > 0 ? deck_.capture_distance : longest;
}

void FaceContact::declare_state(StateStore& store) {
  laws_.declare_state(store);
  const auto ids = slave_->row_ids([this](std::size_t s) { return rules_.at(slave_->sides()[s].shape).points; });
  std::vector<StateVariable> columns = {{"gap", 1, "m"},  {"pressure", 1, "Pa"}, {"slides", 1, "-"},
                                        {"slip", 1, "m"}, {"heat", 1, "J"},      {"area", 1, "m2"},
                                        {"face", 1, "-"}, {"xi 1", 1, "-"},      {"xi 2", 1, "-"}};
  for (const auto& [quantity, unit] : {std::pair{"shear ", "Pa"}, std::pair{"normal ", "-"}, std::pair{"force ", "N"}})
    for (const char* axis : axis_names) columns.push_back({std::string(quantity) + axis, 1, unit});
  points_ = declare_rows(store, name() + "/points", columns, ids);
  penalties_ = declare_rows(store, name() + "/penalty", {{"penalty", 1, "Pa/m"}},
                            slave_->row_ids([](std::size_t) { return 1; }));
  if (deck_.damping > 0) damping_ = declare_rows(store, name() + "/damping", {{"heat", 1, "J"}}, {}, true);
}

int FaceContact::place(int row, int face) const {
  const auto found = place_of_.find(static_cast<long long>(rows_[row].side) << 32 | face);
  return found == place_of_.end() ? -1 : found->second;
}

void FaceContact::sparsity(Assembler& assembler) {
  // every side and face within reach have their matrix entries from the start: the graph, and with it the order of all
  // sums, never changes
  const auto& x = slave_->mesh().coordinates();
  const auto& faces = master_->surface().sides();
  std::vector<std::pair<const SurfaceSide*, const MasterSurface::MasterSide*>> places;
  int slave_nodes = 0, face_nodes = 0;
  for (std::size_t s = 0; s < slave_->sides().size(); ++s) {
    const SurfaceSide& side = slave_->sides()[s];
    for (int face : master_->near(side_box(side.node, side.count, x), deck_.reach)) {
      place_of_[static_cast<long long>(s) << 32 | face] = static_cast<int>(places.size());
      places.emplace_back(&side, &faces[face]);
      slave_nodes = std::max(slave_nodes, side.count);
      face_nodes = std::max(face_nodes, faces[face].count);
    }
  }
  // rows of smaller sides and faces are filled up with the first slave node, to which nothing is added there
  Kokkos::View<int**, Kokkos::LayoutRight> table("point to face dofs", places.size(), 3 * (slave_nodes + face_nodes));
  for (std::size_t p = 0; p < places.size(); ++p) {
    const auto& [side, face] = places[p];
    int* to = context_.space.write_dofs(displacement_, side->node, side->count, &table(p, 0));
    to = context_.space.write_dofs(displacement_, face->node, face->count, to);
    for (int rest = slave_nodes + face_nodes - side->count - face->count; rest > 0; --rest)
      to = context_.space.write_dofs(displacement_, side->node, 1, to);
  }
  dofs_ = table;
  group_ = assembler.add_group(dofs_);
}

Point FaceContact::slave_place(int row, const ConstCoordinateView& x) const {
  return rule(row).place(rows_[row].point, side_coordinates(slave_->sides()[rows_[row].side], x));
}

FaceContact::Weights FaceContact::weights(int row, int nodes, const double* of_face) const {
  const int own = slave_->sides()[rows_[row].side].count;
  Weights result{own + nodes, {}};
  std::copy_n(&rule(row).shape(rows_[row].point, 0), own, result.at);
  for (int a = 0; a < nodes; ++a) result.at[own + a] = -of_face[a];
  return result;
}

void FaceContact::measure(const ConstCoordinateView& x) {
  std::size_t row = 0;
  for (const SurfaceSide& side : slave_->sides()) {
    const ContactRule& points = rules_.at(side.shape);
    const SideCoordinates at = side_coordinates(side, x);
    double areas[max_contact_points];
    contact_areas(points, at, Geometry::space, areas);
    for (int c = 0; c < points.points; ++c, ++row) {
      SideMap<3> map;
      double N[max_side_nodes], dN[2 * max_side_nodes];
      evaluate_shape(side.shape, points.xi[c].data(), N, dN);
      map.compute(side.count, N, dN, [&](int a, int i) { return at[a][i]; });
      rows_[row].area = areas[c];
      rows_[row].outward = {map.normal[0], map.normal[1], map.normal[2]};
    }
  }
}

void FaceContact::begin(const StepView& view) {
  master_->update(view.x_old);
  measure(view.x_old);
  deck_.start_penalties(*slave_, context_.stiffness, view.trial->arrays[penalties_]);
  if (deck_.capture_distance == 0) capture_ = slave_->longest(view.x_old);
  for (std::size_t s = 0; s < candidates_.size(); ++s) {
    const SurfaceSide& side = slave_->sides()[s];
    candidates_[s] = master_->near(side_box(side.node, side.count, view.x_old), 2 * capture_);
  }
}

bool FaceContact::look(int row, const ConstCoordinateView& x, Seen& seen) const {
  const Row& at = rows_[row];
  if (!master_->find(candidates_[at.side], slave_place(row, x), at.outward, capture_, x, seen.face, seen.projection))
    return false;
  seen.place = place(row, seen.face);
  return true;
}

ContactPointLaw FaceContact::law(const StepView& view, int row) const {
  ContactPointLaw result = laws_.in_step(view, deck_.damping);
  result.penalty = view.trial->arrays[penalties_](rows_[row].side, 0);
  result.touch = 1e-9 * capture_;
  result.first_guess = predicting_;
  result.conserves = conserves(view);
  return result;
}

void FaceContact::evaluate(const StepView& view, const Positions& at, int row, const Seen& seen, bool want_tangent,
                           FaceForce& out) const {
  const PointView& old = view.committed->arrays[points_];
  const ContactPointLaw acting = law(view, row);
  const MasterFace face = master_->face(seen.face, at.end);
  const SideCoordinates before = side_coordinates(master_->surface().sides()[seen.face], at.old);
  FacePoint point{acting, face, before, seen.projection, slave_place(row, at.old), rows_[row].area};
  point.gap_old = old(row, column::gap);
  point.force_old = old(row, column::pressure) * old(row, column::area);
  point.shear_old = vector(old, row, column::shear);
  point.normal_old = vector(old, row, column::normal);
  point.slip_old = old(row, column::slip);
  point.slid = old(row, column::slides) > 0;
  point.soil = laws_.soil(*view.committed, slave_->sides()[rows_[row].side], rule(row).xi[rows_[row].point].data());
  face_force(point, want_tangent, out);
}

void FaceContact::write_away(const StepView& view, int row) const {
  const PointView &rows = view.trial->arrays[points_], &old = view.committed->arrays[points_];
  for (std::size_t c = 0; c < rows.extent(1); ++c) rows(row, c) = 0;
  rows(row, column::gap) = capture_;
  rows(row, column::slip) = old(row, column::slip);
  rows(row, column::heat) = old(row, column::heat);
  rows(row, column::face) = -1;
}

void FaceContact::write(const StepView& view, int row, const Seen& seen, const FaceForce& force) const {
  const PointView &rows = view.trial->arrays[points_], &old = view.committed->arrays[points_];
  rows(row, column::gap) = seen.projection.gap;
  rows(row, column::pressure) = force.pressure;
  rows(row, column::slides) = force.slides;
  rows(row, column::slip) = old(row, column::slip) + force.slip;
  rows(row, column::heat) = old(row, column::heat) + force.heat;
  rows(row, column::area) = force.pressure > 0 ? rows_[row].area : 0.0;
  rows(row, column::face) = seen.face;
  for (int k = 0; k < 2; ++k) rows(row, column::xi + k) = seen.projection.xi[k];
  put(rows, row, column::shear, force.shear);
  put(rows, row, column::normal, force.normal);
  put(rows, row, column::force, force.force);
}

void FaceContact::remember(int place, const Weights& weights, double factor, const Point& force) {
  for (int k = 0; k < weights.count; ++k)
    for (int i = 0; i < 3; ++i) correction_.emplace_back(dofs_(place, 3 * k + i), factor * weights.at[k] * force[i]);
}

int FaceContact::residual(const StepView& view, const ResidualView& f) {
  correction_.clear();
  const PointView& old = view.committed->arrays[points_];
  const Positions at = positions(view);
  int failures = 0;
  double damped = 0;
  FaceForce force;
  for (int row = 0; row < static_cast<int>(rows_.size()); ++row) {
    Seen seen;
    if (!look(row, at.end, seen)) {
      write_away(view, row);
      add_old_share(view, row, start_share(old(row, column::gap), capture_, view.impact.damping));
      continue;
    }
    evaluate(view, at, row, seen, false, force);
    if (force.presses && seen.place < 0) ++failures;
    const double before = force.start_share;
    if (seen.place < 0) force = {};
    const Weights w = weights(row, master_->surface().sides()[seen.face].count, force.weight);
    if (force.presses) {
      const double size = view.trial->arrays[penalties_](rows_[row].side, 0) * rows_[row].area;
      const double apart = length(slave_place(row, at.end));
      for (int k = 0; k < w.count; ++k)
        for (int i = 0; i < 3; ++i) {
          f.add(dofs_(seen.place, 3 * k + i), -w.at[k] * force.force[i]);
          f.cancelled(dofs_(seen.place, 3 * k + i), std::abs(w.at[k]) * size * apart);
        }
      if (force.share != 1) remember(seen.place, w, view.end_weight * (force.share - 1), force.force);
    }
    add_old_share(view, row, before);
    if (force.damped != 0) remember(seen.place, w, 1, force.damping);
    damped += force.damped;
    write(view, row, seen, force);
  }
  if (damping_ >= 0) view.trial->arrays[damping_](0, 0) = view.committed->arrays[damping_](0, 0) + damped;
  beyond_reach_ = failures > 0;
  return failures;
}

FaceContact::Weights FaceContact::old_weights(const State& committed, int row) const {
  const PointView& old = committed.arrays[points_];
  const auto& side = master_->surface().sides()[static_cast<int>(old(row, column::face))];
  const double xi[2] = {old(row, column::xi), old(row, column::xi + 1)};
  double N[max_side_nodes], dN[2 * max_side_nodes];
  evaluate_shape(side.shape, xi, N, dN);
  return weights(row, side.count, N);
}

void FaceContact::add_old_share(const StepView& view, int row, double share) {
  const PointView& old = view.committed->arrays[points_];
  if (!conserves(view) || !(old(row, column::pressure) > 0)) return;
  const int there = place(row, static_cast<int>(old(row, column::face)));
  if (there >= 0)
    remember(there, old_weights(*view.committed, row), share - (1 - view.end_weight), vector(old, row, column::force));
}

void FaceContact::add_tangent(const StepView& view, const MatrixScatter& to, int row, const Seen& seen,
                              const FaceForce& force, double weight) const {
  const PointView& old = view.committed->arrays[points_];
  // the matrix has no entries that couple the point with another face, on which its old force acted
  const bool leaves =
      conserves(view) && old(row, column::pressure) > 0 && static_cast<int>(old(row, column::face)) == seen.face;
  if (!leaves && !force.presses && force.damped == 0) return;
  const int own = slave_->sides()[rows_[row].side].count;
  const Weights w = weights(row, master_->surface().sides()[seen.face].count, force.weight),
                before = leaves ? old_weights(*view.committed, row) : Weights{w.count, {}};
  const Point leaving = 1 / view.end_weight * vector(old, row, column::force);
  for (int a = 0; a < w.count; ++a)
    for (int i = 0; i < 3; ++i) {
      double by_d[3];  // derivatives of the force on node a by d = sum_b w_b x_b
      for (int j = 0; j < 3; ++j) {
        by_d[j] = w.at[a] * force.acting_slope[i][j] + before.at[a] * leaving[i] * force.start_share_slope[j];
        if (a >= own) by_d[j] -= force.weight_slope[a - own][j] * force.acting[i];
      }
      for (int b = 0; b < w.count; ++b)
        for (int j = 0; j < 3; ++j) to.add(seen.place, 3 * a + i, 3 * b + j, -weight * by_d[j] * w.at[b]);
    }
}

void FaceContact::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const MatrixScatter to = assembler.scatter(group_);
  const double moved = conserves(view) ? view.impact.conjugate : 1.0;
  const Positions at = positions(view);
  FaceForce force;
  for (int row = 0; row < static_cast<int>(rows_.size()); ++row) {
    Seen seen;
    if (!look(row, at.end, seen) || seen.place < 0) continue;
    evaluate(view, at, row, seen, true, force);
    add_tangent(view, to, row, seen, force, moved * weight);
  }
}

void FaceContact::histories(const StepView& view, Report& values) {
  const PointView& rows = view.committed->arrays[points_];
  SlaveSums here;
  for (int row = 0; row < static_cast<int>(rows_.size()); ++row) {
    here.force += vector(rows, row, column::force);
    here.area += rows(row, column::area);
    here.slides += rows(row, column::slides);
    here.heat += rows(row, column::heat);
    if (rows(row, column::pressure) > 0) here.deepest = std::max(here.deepest, -rows(row, column::gap));
  }
  if (damping_ >= 0) here.damped = view.committed->arrays[damping_](0, 0);
  const SlaveSums all = report_slave(*context_.space.mesh().comm(), 3, name(), deck_, here, values);
  if (laws_.friction()) values[name() + "/friction heat"] = {"J", all.heat};
  if (laws_.friction()) values[name() + "/sliding points"] = {"-", all.slides};
}

double FaceContact::step_limit(const State& committed, double) const {
  return closing_limit(context_.space, *slave_, master_->surface(), deck_.advance_limit, committed);
}

void FaceContact::relocate(const ConstCoordinateView& x_old, State& committed) {
  // the history is the shear stress at which friction continues, and the path slid
  const PointView& rows = committed.arrays[points_];
  int first = 0;
  for (const SurfaceSide& side : slave_->sides()) {
    const ContactRule& points = rules_.at(side.shape);
    const SideCoordinates before = side_coordinates(side, x_old), after = side_coordinates(side, committed.coordinates);
    std::vector<Point> from, to;
    for (int c = 0; c < points.points; ++c) {
      from.push_back(points.place(c, before));
      to.push_back(points.place(c, after));
    }
    const SideShifts shifts(from, to, side.shape, before);
    shifts.convect(rows, first, column::slip);
    for (int i = 0; i < 3; ++i) shifts.convect(rows, first, column::shear + i);
    first += points.points;
  }
}

void FaceContact::take_evaluated(const State& evaluated, State& committed) {
  Kokkos::deep_copy(committed.arrays[points_], evaluated.arrays[points_]);
}

std::vector<double> FaceContact::nodal_mean(const std::function<double(int row)>& quantity) const {
  const int nodes = context_.space.mesh().num_nodes();
  std::vector<double> weighted(nodes, 0.0), weights(nodes, 0.0);
  for (int row = 0; row < static_cast<int>(rows_.size()); ++row) {
    const SurfaceSide& side = slave_->sides()[rows_[row].side];
    for (int a = 0; a < side.count; ++a) {
      const double near = nearness(rule(row), rows_[row].point, a);
      weighted[side.node[a]] += near * quantity(row);
      weights[side.node[a]] += near;
    }
  }
  return slave_->mean(std::move(weighted), std::move(weights));
}

std::vector<double> FaceContact::nodal_pressure(const State& state) const {
  return nodal_mean([&](int row) { return state.arrays[points_](row, column::pressure); });
}

std::vector<double> FaceContact::nodal_shear(const State& state) const {
  if (!laws_.friction()) return {};
  return nodal_mean([&](int row) { return length(vector(state.arrays[points_], row, column::shear)); });
}

}  // namespace mudline
