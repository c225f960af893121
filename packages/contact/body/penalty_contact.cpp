#include "contact/body/penalty_contact.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "contact/body/body_search.hpp"
#include "contact/conjugate_position.hpp"
#include "contact/convection.hpp"
#include "tensor/vec.hpp"

namespace mudline {

void PenaltyContact::declare_state(StateStore& store) {
  laws_.declare_state(store);
  body_->declare_state(store);
  const auto ids = surface_->row_ids([this](std::size_t s) { return first_row_[s + 1] - first_row_[s]; });
  rows_.declare_state(store, name() + "/", ids, axes(), laws_.friction() != nullptr, deck_.augmented());
  if (deck_.has_film()) deck_.film.declare_state(store, name() + "/", ids, axes());
  deck_.initial_gap.declare_state(store, name() + "/", ids);
  penalties_ = declare_rows(store, name() + "/penalty", {{"penalty", 1, "Pa/m"}},
                            surface_->row_ids([](std::size_t) { return 1; }));
  std::vector<StateVariable> sums = {{"work", 1, "J"}, {"damping heat", 1, "J"}};
  for (int i = 0; i < axes(); ++i) sums.push_back({std::string("damping ") + axis_names[i], 1, "N"});
  work_ = declare_rows(store, name() + "/work", sums, {}, true);
}

void PenaltyContact::sparsity(Assembler& assembler) {
  for (CellShape shape : surface_->shapes()) {
    const ElementDofs& dofs = surface_->dofs(shape);
    shapes_[shape] = {assembler.add_group(dofs), RowLists(dofs), Kokkos::View<SideContact*>("sides", dofs.extent(0)),
                      PointView("later", dofs.extent(0), dofs.extent(1))};
  }
  starts_ = Kokkos::View<ContactStart*>("starts", first_row_.back());
  happens_ = Kokkos::View<ContactPoint*>("points", first_row_.back());
  if (leak_) leak_->sparsity(assembler);
}

void PenaltyContact::begin(const StepView& view) {
  deck_.start_penalties(*surface_, context_.stiffness, view.trial->arrays[penalties_]);
  start_multipliers(view);
  if (deck_.has_film()) deck_.film.cover(covered_sides(*view.committed));
  if (leak_) leak_->open(view.flow ? covered_sides(*view.committed) : std::vector<char>());
  const BodyPlacement from = body_->placement(*view.committed), to = body_->placement(*view.trial);
  // what a free body will do in the step is not known yet
  const double advance = body_->released() ? body_->speed(*view.committed, view.dt) * view.dt
                                           : length(to.centre - from.centre) +
                                                 body_->reach() * length((to.turn * from.turn.inverse()).vector());
  capture_ = deck_.capture_distance > 0 ? deck_.capture_distance : 2 * surface_->longest(view.x_old) + advance;
  for (std::size_t s = 0; s < candidate_.size(); ++s) candidate_[s] = least_gap(s, view.x_old, to) <= capture_;
}

double PenaltyContact::least_gap(std::size_t side, const ConstCoordinateView& coordinates_now,
                                 const BodyPlacement& placement) const {
  const SurfaceSide& at = surface_->sides()[side];
  const SideCoordinates x = side_coordinates(at, coordinates_now);
  Bounds box = Bounds::nothing();
  for (int a = 0; a < at.count; ++a) box.enclose(x[a]);
  const Point across = box.high - box.low;
  return body_->gap(placement, box.low + 0.5 * across) - 0.5 * length(across);
}

ContactPoint PenaltyContact::away(const StepView& view, int row) const {
  ContactPoint point{};
  point.gap = capture_;
  point.shear = rows_.shear(*view.committed, row);
  point.shear.shear = {};
  point.shear.slides = false;
  return point;
}

ContactStart PenaltyContact::point_start(const StepView& view, std::size_t side, int row) const {
  const State &committed = *view.committed, &trial = *view.trial;
  const SurfaceSide& at = surface_->sides()[side];
  ContactStart start;
  start.offset = deck_.initial_gap.offset(trial, row);
  start.shear = rows_.shear(committed, row);
  start.force = rows_.total(committed, row);
  start.normal_force = rows_.pressure(committed, row) * rows_.area(committed, row);
  start.soil = laws_.soil(committed, at, rule(at).xi[row - first_row_[side]].data());
  if (!deck_.augmented()) return start;
  const double penalty = trial.arrays[penalties_](side, 0);
  start.shift = rows_.normal_multiplier(trial, row) / penalty;
  start.shift_old = rows_.normal_multiplier(committed, row) / penalty;
  if (laws_.friction())
    start.shear.shear =
        start.shear.shear + rows_.shear_multiplier(trial, row) - initial_shear_multiplier(committed, row);
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
  result.first_guess = predicting_;
  result.conserves = conserves(view);
  return result;
}

SideContact PenaltyContact::side_contact(const StepView& view, const Positions& positions, std::size_t side) const {
  const SurfaceSide& at = surface_->sides()[side];
  SideContact contact;
  contact.near = candidate_[side];
  contact.first = first_row_[side];
  if (!contact.near) return contact;
  contact.x_old = side_coordinates(at, positions.x_old);
  contact.x = side_coordinates(at, positions.x_end);
  contact.law = law(view, side);
  contact.reach = touch_;
  // the force that moves the body until it touches is not known: every linearisation lets it move ten times as far
  contact.reach_share = std::pow(0.1, view.linearisation);
  if (deck_.has_film()) {
    const Point weight = context_.water_weight ? context_.water_weight(at.block, view.time_end) : Point{};
    contact.film = deck_.film.of_side(view, side, weight);
    contact.law.film = contact.film.acts;
  }
  contact.pressure_nodes = surface_->pressure_nodes(at.shape);
  for (int a = 0; a < contact.pressure_nodes; ++a)
    contact.pressure[a] = view.value_end(surface_->dofs(at.shape)(at.row, axes() * at.count + a));
  return contact;
}

std::vector<ContactSides> PenaltyContact::look(const StepView& view, const Positions& positions) const {
  const BodyInStep body = body_in_step(*body_, positions.body_old, positions.body_end);
  for (std::size_t s = 0; s < surface_->sides().size(); ++s) {
    const SurfaceSide& at = surface_->sides()[s];
    SideContact& contact = shapes_.at(at.shape).sides(at.row);
    contact = side_contact(view, positions, s);
    if (!contact.near) continue;
    for (int row = first_row_[s]; row < first_row_[s + 1]; ++row) {
      const int c = row - first_row_[s];
      starts_(row) = point_start(view, s, row);
      if (contact.film.acts) deck_.film.start(view, row, rule(at).place(c, contact.x_old), starts_(row));
      search(*body_, body, rule(at), contact, c, starts_(row));
    }
  }
  std::vector<ContactSides> result;
  for (const auto& [shape, of_shape] : shapes_)
    result.push_back({rules_.at(shape), context_.space.mesh().geometry(), body, of_shape.sides, starts_, happens_});
  return result;
}

bool PenaltyContact::conserves(const StepView& view) const {
  if (!view.inertia || view.kind != StepView::Kind::step) return false;
  if (deck_.impact == PenaltyParameters::Impact::automatic)
    return !deck_.augmented() && !deck_.has_film() && laws_.normal().linear() && body_->unknowns().count > 0;
  return deck_.impact == PenaltyParameters::Impact::conserving;
}

void PenaltyContact::add_damping(const State& trial) const {
  const PointView& sums = trial.arrays[work_];
  for (int row = 0; row < first_row_.back(); ++row) {
    sums(0, 1) += happens_(row).damped;
    for (int i = 0; i < axes(); ++i) sums(0, 2 + i) += happens_(row).damping[i];
  }
}

namespace {

// Kernels over the sides, and over the points.
struct AddLater {
  PointView later;
  VectorScatter to;
  KOKKOS_FUNCTION void operator()(int s) const {
    to.open(s);
    for (std::size_t a = 0; a < later.extent(1); ++a) {
      const double size = ::fabs(later(s, a));
      if (size != 0) to.add(s, static_cast<int>(a), -later(s, a), size, size);
    }
  }
};
struct WritePoint {
  Kokkos::View<const ContactPoint*> points;
  PointRows::Writer rows;
  WaterFilm::Writer film;
  KOKKOS_FUNCTION void operator()(int row) const {
    rows.write(row, points(row));
    film.write(row, points(row));
  }
};

}  // namespace

void PenaltyContact::correction(const StepView& view, const ResidualView& f) {
  for (const auto& [shape, of_shape] : shapes_) {
    const PointView later = of_shape.later;
    in_order("contact rows", of_shape.rows, 0, static_cast<int>(later.extent(0)),
             VectorScatter{f, surface_->dofs(shape)}, [&](int first, int last, const VectorScatter& to) {
               Kokkos::parallel_for("later", Kokkos::RangePolicy<>(first, last), AddLater{later, to});
             });
  }
  if (leak_) leak_->add(view, f);
  if (laws_.friction() && temperature_ >= 0 && view.flow) add_heat(view, f);
}

void PenaltyContact::add_heat(const StepView& view, const ResidualView& f) const {
  const auto& dofs = context_.space.node_dof(temperature_);
  for (std::size_t s = 0; s < surface_->sides().size(); ++s) {
    const SurfaceSide& side = surface_->sides()[s];
    for (int row = first_row_[s]; row < first_row_[s + 1]; ++row) {
      const double heat = rows_.shear(*view.trial, row).dissipated - rows_.shear(*view.committed, row).dissipated;
      const double* const share = &rule(side).corner(row - first_row_[s], 0);
      for (int a = 0; a < num_corners(side.shape); ++a) f.add(dofs(side.node[a]), -share[a] * (heat / view.dt));
    }
  }
}

PointForce PenaltyContact::local_force(const State& state) const {
  PointForce sum;
  for (int row = 0; row < first_row_.back(); ++row) {
    const PointForce total = rows_.total(state, row);
    sum = {sum.force + total.force, sum.moment + total.moment};
  }
  return sum;
}

double PenaltyContact::work(const PointForce& before, const PointForce& now, const BodyPlacement& from,
                            const BodyPlacement& to) {
  const Point turned = (to.turn * from.turn.inverse()).vector(), moved = to.centre - from.centre;
  return 0.5 * (dot(before.force + now.force, moved) + dot(before.moment + now.moment, turned));
}

int PenaltyContact::residual(const StepView& view, const ResidualView& f) {
  const PointView& done = view.trial->arrays[work_];
  done(0, 1) = view.committed->arrays[work_](0, 1);
  for (int i = 0; i < axes(); ++i) done(0, 2 + i) = 0;
  for (std::size_t s = 0; s < surface_->sides().size(); ++s) {
    if (candidate_[s]) continue;
    for (int row = first_row_[s]; row < first_row_[s + 1]; ++row) happens_(row) = away(view, row);
  }
  int failures = 0;
  const std::vector<ContactSides> sides = look(view, positions(view));
  std::size_t k = 0;
  for (const auto& [shape, of_shape] : shapes_)
    failures += add_side_forces(sides[k++], of_shape.rows, {f, surface_->dofs(shape)}, of_shape.later);
  Kokkos::parallel_for("contact points", Kokkos::RangePolicy<>(0, first_row_.back()),
                       WritePoint{happens_, rows_.writer(*view.trial), deck_.film.writer(*view.trial)});
  if (damps(view)) add_damping(*view.trial);
  done(0, 0) =
      view.committed->arrays[work_](0, 0) + work(local_force(*view.committed), local_force(*view.trial),
                                                 body_->placement(*view.committed), body_->placement(*view.trial));
  set_reach(view);
  return failures;
}

void PenaltyContact::set_reach(const StepView& view) {
  touch_ = 0;
  if (view.inertia || !body_->released()) return;
  const State& trial = *view.trial;
  double nearest = 1e300, everywhere = 0;
  for (int row = 0; row < first_row_.back(); ++row)
    if (rows_.area(trial, row) > 0)
      nearest = std::min(nearest, rows_.active(trial, row) ? -1.0 : rows_.gap(trial, row));
  Teuchos::reduceAll(*context_.space.mesh().comm(), Teuchos::REDUCE_MIN, nearest, Teuchos::outArg(everywhere));
  if (everywhere >= 0 && everywhere < 1e300) touch_ = everywhere + 1e-3 * surface_->shortest(view.x_old);
}

void PenaltyContact::mark_pressed(const State& state, std::vector<char>& nodes) const {
  for (std::size_t s = 0; s < surface_->sides().size(); ++s) {
    bool presses = false;
    for (int row = first_row_[s]; row < first_row_[s + 1]; ++row) presses = presses || rows_.active(state, row);
    if (!presses) continue;
    const SurfaceSide& side = surface_->sides()[s];
    for (int a = 0; a < side.count; ++a) nodes[side.node[a]] = 1;
  }
}

void PenaltyContact::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const SideWeights weights{weight, conserves(view) ? view.impact.conjugate : 1.0, deck_.has_film()};
  const std::vector<ContactSides> sides = look(view, positions(view));
  std::size_t k = 0;
  for (const auto& [shape, of_shape] : shapes_)
    add_side_tangents(sides[k++], of_shape.rows, assembler.scatter(of_shape.group), weights);
  if (leak_) leak_->jacobian(view, assembler);
}

bool PenaltyContact::covered(std::size_t side, const State& committed, const BodyPlacement& placement) const {
  // The criterion is the distance: with the pressure alone single points along a stretched side would lift off by
  // micrometres, and a vertex that is drained for a step loses its pore pressure.
  const SideCoordinates x = side_coordinates(surface_->sides()[side], committed.coordinates);
  const double near = deck_.sealing_gap * edges(surface_->sides()[side], committed.coordinates).second;
  if (least_gap(side, committed.coordinates, placement) >= near) return false;
  const ContactRule& points = rule(surface_->sides()[side]);
  int count = 0;
  for (int c = 0; c < points.points; ++c)
    count += gap(committed, first_row_[side] + c, placement, points.place(c, x)) < near;
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
  // a body that is still far away may cover half the distance
  return speed > 0 ? std::max(deck_.advance_limit * edge, 0.5 * everywhere) / speed : 1e300;
}

std::string PenaltyContact::hint(const StepView& view) const {
  if (view.inertia || touch_ == 0) return "";
  return "body '" + deck_.body + "' touches nothing in contact '" + name_ +
         "' and has no inertia in a quasi-static stage: hold it, or release it in a dynamic stage";
}

/// Sums of a history over the points of all ranks.
struct PenaltyContact::Sums {
  enum : int {
    reaction,
    friction = 3,
    damping = 6,
    tip = 9,
    area,
    active,
    work,
    heat,
    sliding,
    damping_heat,
    water,
    vapour,
    film,
    moment = film + 3,
    count = moment + 3
  };
  double of[count] = {}, deepest = 0;
};

PenaltyContact::Sums PenaltyContact::sums(const State& state) const {
  const PointView& done = state.arrays[work_];
  const PointForce force = local_force(state);
  Sums here, all;
  double* const local = here.of;
  for (int i = 0; i < axes(); ++i) {
    local[Sums::reaction + i] = -force.force[i];
    local[Sums::damping + i] = -done(0, 2 + i);
  }
  // the points' moments are about the centre of mass
  const Point arm = body_->placement(state).centre - body_->position(state);
  const Point moment = force.moment + cross(arm, force.force);
  for (int i = 0; i < 3; ++i) local[Sums::moment + i] = -moment[i];
  local[Sums::work] = done(0, 0);
  local[Sums::damping_heat] = done(0, 1);
  if (deck_.has_film()) {
    const WaterFilm::Sums between = deck_.film.sums(state);
    local[Sums::water] = between.water;
    local[Sums::vapour] = between.vapour;
    for (int i = 0; i < axes(); ++i) local[Sums::film + i] = -between.force[i];
  }
  for (int row = 0; row < first_row_.back(); ++row) {
    const ShearState shear = rows_.shear(state, row);
    for (int i = 0; i < axes(); ++i) local[Sums::friction + i] -= rows_.friction(state, row)[i];
    local[Sums::heat] += shear.dissipated;
    local[Sums::sliding] += shear.slides;
    if (!rows_.active(state, row)) continue;
    if (rows_.height(state, row) < body_->tip_height()) local[Sums::tip] -= rows_.total(state, row).force[axes() - 1];
    local[Sums::area] += rows_.area(state, row);
    local[Sums::active] += 1;
    here.deepest = std::max(here.deepest, -rows_.gap(state, row));
  }
  const Teuchos::Comm<int>& comm = *context_.space.mesh().comm();
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(Sums::count), here.of, all.of);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, here.deepest, Teuchos::outArg(all.deepest));
  return all;
}

void PenaltyContact::histories(const StepView& view, Report& values) {
  const State& state = *view.committed;
  const Sums all = sums(state);
  const double* const sum = all.of;
  const auto add_vector = [&](const char* what, int first, const char* unit = "N") {
    for (int i = 0; i < axes(); ++i) values[name() + "/" + what + " " + axis_names[i]] = {unit, sum[first + i]};
  };
  const std::string up = axis_names[axes() - 1];
  add_vector("reaction", Sums::reaction);
  values[name() + "/tip reaction " + up] = {"N", sum[Sums::tip]};
  values[name() + "/shaft reaction " + up] = {"N", sum[Sums::reaction + axes() - 1] - sum[Sums::tip]};
  const bool half = axes() == 2 && body_->contour().extent() == ContourExtent::half;
  if (axes() == 3) add_vector("moment", Sums::moment, "N m");
  if (axes() == 2 && !half) values[name() + "/moment"] = {"N m", sum[Sums::moment + 2]};
  values[name() + "/contact area"] = {"m2", sum[Sums::area]};
  values[name() + "/active points"] = {"-", sum[Sums::active]};
  values[name() + "/maximum penetration"] = {"m", all.deepest};
  values[name() + "/work"] = {"J", sum[Sums::work], true};
  if (deck_.has_film()) {
    values[name() + "/film water"] = {"m3", sum[Sums::water]};
    values[name() + "/film vapour"] = {"m3", sum[Sums::vapour]};
    add_vector("film force", Sums::film);
  }
  if (deck_.damping > 0) {
    values[name() + "/damping heat"] = {"J", sum[Sums::damping_heat]};
    add_vector("damping", Sums::damping);
  }
  if (deck_.augmented()) {
    const auto [gap, stretch, spring] = misfit(state).largest(*context_.space.mesh().comm());
    values[name() + "/weighted gap"] = {"m", gap};
    if (laws_.friction()) values[name() + "/stretch"] = {"m", stretch};
  }
  if (!laws_.friction()) return;
  add_vector("friction", Sums::friction);
  values[name() + "/friction heat"] = {"J", sum[Sums::heat]};
  values[name() + "/sliding points"] = {"-", sum[Sums::sliding]};
}

std::vector<double> PenaltyContact::nodal_mean(const std::function<double(int row)>& quantity) const {
  const int nodes = context_.space.mesh().num_nodes();
  std::vector<double> weighted(nodes, 0.0), weights(nodes, 0.0);
  const auto& sides = surface_->sides();
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const ContactRule& r = rule(sides[s]);
    for (int a = 0; a < sides[s].count; ++a)
      for (int c = 0; c < r.points; ++c) {
        const double near = nearness(r, c, a);
        weighted[sides[s].node[a]] += near * quantity(first_row_[s] + c);
        weights[sides[s].node[a]] += near;
      }
  }
  return surface_->mean(std::move(weighted), std::move(weights));
}

std::vector<double> PenaltyContact::nodal_pressure(const State& state) const {
  return nodal_mean([&](int row) { return rows_.pressure(state, row); });
}

std::vector<double> PenaltyContact::nodal_shear(const State& state) const {
  if (!laws_.friction()) return {};
  return nodal_mean([&](int row) {
    const Point shear = rows_.shear(state, row).shear;
    return axes() == 2 ? shear[0] : length(shear);
  });
}

void PenaltyContact::relocate(const ConstCoordinateView& x_old, State& committed) {
  // gaps and pressures are evaluated again at the new positions; the shear stress, the path slid, multipliers and
  // initial gaps are history and are convected along the side, see SideShifts
  std::vector<std::pair<int, int>> convected;  // (array, column)
  if (laws_.friction())
    for (int column = 0; column <= rows_.slip_column(); ++column) convected.emplace_back(rows_.frictions(), column);
  if (deck_.augmented())
    for (int column = 0; column <= rows_.shears(); ++column) convected.emplace_back(rows_.multipliers(), column);
  if (deck_.has_film()) convected.emplace_back(deck_.film.array(), WaterFilm::vapour_column);
  if (deck_.initial_gap.adjusts()) convected.emplace_back(deck_.initial_gap.array(), 0);
  if (convected.empty()) return;
  const auto& sides = surface_->sides();
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const int points = first_row_[s + 1] - first_row_[s];
    const SideCoordinates before = side_coordinates(sides[s], x_old),
                          after = side_coordinates(sides[s], committed.coordinates);
    std::vector<Point> from, to;
    for (int c = 0; c < points; ++c) {
      from.push_back(rule(sides[s]).place(c, before));
      to.push_back(rule(sides[s]).place(c, after));
    }
    const SideShifts shifts(from, to, sides[s].shape, before);
    for (const auto& [array, column] : convected) shifts.convect(committed.arrays[array], first_row_[s], column);
  }
  if (!deck_.augmented()) return;
  for (int row = 0; row < first_row_.back(); ++row) {
    double& normal = rows_.normal_multiplier(committed, row);
    normal = std::max(normal, 0.0);
  }
}

std::vector<SurfaceRows> PenaltyContact::surface_rows(const ConstCoordinateView& x) const {
  SurfaceRows of_points, of_sides;
  for (const SurfaceSide& side : surface_->sides()) {
    const SideCoordinates at = side_coordinates(side, x);
    double area[max_contact_points] = {};
    contact_areas(rule(side), at, context_.space.mesh().geometry(), area);
    for (int c = 0; c < rule(side).points; ++c) {
      of_points.places.push_back(rule(side).place(c, at));
      of_points.areas.push_back(area[c]);
    }
    Point centre{};
    const int corners = axes() == 3 ? num_corners(side.shape) : 2;
    for (int c = 0; c < corners; ++c) centre += 1.0 / corners * at[c];
    of_sides.places.push_back(centre);
    of_sides.areas.push_back(std::accumulate(area, area + rule(side).points, 0.0));
  }
  std::vector<SurfaceRows> result;
  const auto add = [&](int array, SurfaceRows rows) {
    rows.array = array;
    result.push_back(std::move(rows));
  };
  add(penalties_, of_sides);
  for (int array : {rows_.points(), rows_.frictions(), rows_.multipliers(), deck_.has_film() ? deck_.film.array() : -1,
                    deck_.initial_gap.array()})
    if (array >= 0) add(array, of_points);
  return result;
}

void PenaltyContact::take_evaluated(const State& evaluated, State& committed) { rows_.copy(evaluated, committed); }

}  // namespace mudline
