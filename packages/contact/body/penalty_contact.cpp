#include "contact/body/penalty_contact.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

#include "contact/body/body_search.hpp"
#include "contact/conjugate_position.hpp"
#include "tensor/vec.hpp"

namespace mudline {

void PenaltyContact::declare_state(StateStore& store) {
  body_->declare_state(store);
  std::vector<StateVariable> more = {{"height", 1, "m"}};
  if (axes() == 2)
    more.push_back({"moment", 1, "N m", Transfer::total});
  else
    for (const char* axis : axis_names) more.push_back({std::string("moment ") + axis, 1, "N m", Transfer::total});
  declare_points(store, more);
  std::vector<StateVariable> sums = {{"work", 1, "J"}, {"damping heat", 1, "J"}};
  for (int i = 0; i < axes(); ++i) sums.push_back({std::string("damping ") + axis_names[i], 1, "N"});
  work_ = store.declare(ArrayInfo::of_sum(name() + "/work", sums).not_shown());
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
  begin_parts(view);
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

void PenaltyContact::write(const State& trial, int row, const ContactPoint& point) const {
  write_point(trial, row, point);
  double* const more = rows_.more(trial, row);
  more[0] = point.height;
  if (axes() == 2)
    more[1] = point.total.moment[2];
  else
    std::copy_n(point.total.moment.data(), 3, more + 1);
}

PointForce PenaltyContact::total(const State& state, int row) const {
  const double* const moment = rows_.more(state, row) + 1;
  return {rows_.force(state, row), axes() == 2 ? Point{0, 0, moment[0]} : Point{moment[0], moment[1], moment[2]}};
}

PenaltyContact::Positions PenaltyContact::positions(const StepView& view) const {
  if (!conserves(view))
    return {body_->placement(*view.committed), body_->placement(*view.trial), view.x_old, view.x_end};
  return {moved_ahead(*body_, *view.committed, view.impact.ahead_old, view.impact.lead),
          moved_ahead(*body_, *view.trial, view.impact.ahead_end, view.impact.lead),
          moved_ahead(context_.space, view.x_old, view.impact.ahead_old),
          moved_ahead(context_.space, view.x_end, view.impact.ahead_end)};
}

SideContact PenaltyContact::side_contact(const StepView& view, const Positions& positions, std::size_t side) const {
  const SurfaceSide& at = surface_->sides()[side];
  SideContact contact;
  contact.near = candidate_[side];
  contact.first = first_row_[side];
  if (!contact.near) return contact;
  contact.x_old = side_coordinates(at, positions.x_old);
  contact.x = side_coordinates(at, positions.x_end);
  contact.law = law(view, side, deck_.damping);
  contact.law.conserves = conserves(view);
  contact.reach = touch_;
  // the force that moves the body until it touches is not known: every linearisation lets it move ten times as far
  contact.reach_share = std::pow(0.1, view.linearisation);
  contact.film = film(view, side);
  contact.law.film = contact.film.acts;
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
      static_cast<PointHistory&>(starts_(row)) = history(view, s, row, rule(at).place(c, contact.x_old));
      starts_(row).force = total(*view.committed, row);
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
    return !deck_.augmented() && !deck_.drainage.has_film() && laws_.normal().linear() && body_->unknowns().count > 0;
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

/// Kernel over the sides.
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
    const PointForce point = total(state, row);
    sum = {sum.force + point.force, sum.moment + point.moment};
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
    for (int row = first_row_[s]; row < first_row_[s + 1]; ++row) happens_(row) = away(*view.committed, row, capture_);
  }
  int failures = 0;
  const std::vector<ContactSides> sides = look(view, positions(view));
  std::size_t k = 0;
  for (const auto& [shape, of_shape] : shapes_)
    failures += add_side_forces(sides[k++], of_shape.rows, {f, surface_->dofs(shape)}, of_shape.later);
  for (int row = 0; row < first_row_.back(); ++row) write(*view.trial, row, happens_(row));
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
  const SideWeights weights{weight, conserves(view) ? view.impact.conjugate : 1.0, deck_.drainage.has_film()};
  const std::vector<ContactSides> sides = look(view, positions(view));
  std::size_t k = 0;
  for (const auto& [shape, of_shape] : shapes_)
    add_side_tangents(sides[k++], of_shape.rows, assembler.scatter(of_shape.group), weights);
  if (leak_) leak_->jacobian(view, assembler);
}

bool PenaltyContact::may_be_near(const State& committed, std::size_t side, double distance) const {
  return least_gap(side, committed.coordinates, body_->placement(committed)) < distance;
}

std::optional<PointContact::Nearest> PenaltyContact::nearest(const State& committed, std::size_t, const Point& place,
                                                             const Point&, double) const {
  const BodyPlacement placement = body_->placement(committed);
  if (body_->dimension() == 3) {
    const SurfaceProjection projection = body_->projection(placement, place);
    return Nearest{projection.gap, projection.normal, {}};
  }
  const ContourProjection projection = body_->closest(placement, in_plane(place));
  return Nearest{projection.gap, {projection.normal[0], projection.normal[1], 0}, {}};
}

void PenaltyContact::write_first(const State& committed, int row, const Point& place, const Nearest&,
                                 ContactPoint& point) const {
  const BodyPlacement placement = body_->placement(committed);
  point.height = body_->height(placement, place);
  point.total.moment = cross(place - placement.centre, point.total.force);
  write(committed, row, point);
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
    moment,
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
  for (int row = 0; row < first_row_.back(); ++row) {
    const ShearState shear = rows_.shear(state, row);
    for (int i = 0; i < axes(); ++i) local[Sums::friction + i] -= rows_.friction(state, row)[i];
    local[Sums::heat] += shear.dissipated;
    local[Sums::sliding] += shear.slides;
    if (!rows_.active(state, row)) continue;
    if (rows_.more(state, row)[0] < body_->tip_height()) local[Sums::tip] -= total(state, row).force[axes() - 1];
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
  report_parts(state, -1.0, values);
  if (deck_.damping > 0) {
    values[name() + "/damping heat"] = {"J", sum[Sums::damping_heat]};
    add_vector("damping", Sums::damping);
  }
  if (!laws_.friction()) return;
  add_vector("friction", Sums::friction);
  values[name() + "/friction heat"] = {"J", sum[Sums::heat]};
  values[name() + "/sliding points"] = {"-", sum[Sums::sliding]};
}

}  // namespace mudline
