#include "bodies/rigid_body.hpp"

#include "core/guarded.hpp"

#include <algorithm>
#include <cmath>

namespace mudline {

void RigidBody::parameters(Parameters& p) {
  p.add("position", position_, "m", "Where the body's reference point (the tip of its contour) is before any motion");
  p.add(
      "mass", properties_.mass, "kg", non_negative(),
      "Axisymmetric: of the whole body; plane strain: per metre of depth, of the modelled half if the contour is half");
  p.add("moment of inertia", properties_.moment_of_inertia, "kg m2", non_negative(),
        "About the centre of mass, per metre of depth; needed by a body that may rotate");
  p.add("centre of mass", centre_, "m", "In the body's frame, from the reference point");
  p.add("volume", properties_.volume, "m3", non_negative(),
        "Volume that displaces water; 0: that of the contour, if it is closed");
  p.add("tip height", tip_height_, "m", non_negative(),
        "Height above the reference point below which contact forces are the tip's, above it the shaft's; 0: the "
        "shape's own");
  p.passes_on("contour", "Shape of the body in the plane; 'type' names a contour");
  p.passes_on("surface", "Shape of the body in space; 'type' names a surface");
  p.passes_on("motion", "How the body moves, unless a stage says otherwise; 'type' names a motion");
}

std::shared_ptr<RigidBody> RigidBody::read(const Section& section, Geometry geometry,
                                           const BodyRegistries& registries) {
  std::shared_ptr<RigidBody> body(new RigidBody);
  body->name_ = section.name();
  Parameters p(section);
  body->parameters(p);
  p.finish();
  body->properties_.geometry = geometry;
  const bool space = geometry == Geometry::space;
  for (const char* other : {"contour", "surface"})
    if (section.has_section(other) && space != (std::string(other) == "surface"))
      section.fail(space ? "a body in space has a 'surface'; a contour is turned into one by the type 'revolved'"
                         : "a body in the plane has a 'contour'",
                   other);
  if (space)
    body->read_surface(section, registries);
  else
    body->read_contour(section, registries);
  body->own_motion_ = body->motion_ = body->read_motion(section.section("motion"), registries.motions);
  return body;
}

void RigidBody::read_contour(const Section& section, const BodyRegistries& registries) {
  const Section entry = section.section("contour");
  const auto shape = registries.contours.create(entry);
  contour_ = std::make_unique<Contour>(shape->contour(entry));
  of_revolution_ = shape->named() == ContourShape::Named::of_revolution;
  enclosed_ = std::make_unique<ContourVolume>(contour(), properties_.geometry);
  if (tip_height_ == 0) tip_height_ = shape->tip_height();
  const bool half = contour().extent() == ContourExtent::half;
  if (properties_.geometry == Geometry::axisymmetric && !half)
    entry.fail("an axisymmetric body has a half contour, not a full one", "extent");
  if (properties_.geometry == Geometry::axisymmetric && position_[0] != 0)
    section.fail("the axis of an axisymmetric body is r = 0: the first value must be 0", "position");
  if (half && centre_[0] != 0)
    section.fail("the centre of mass of a body with a half contour is on its axis: the first value must be 0",
                 "centre of mass");
  properties_.enclosed = enclosed_.get();
  if (properties_.volume == 0) properties_.volume = enclosed_->total();
  reach_ = 0.5 * contour().length();
}

void RigidBody::read_surface(const Section& section, const BodyRegistries& registries) {
  const Section entry = section.section("surface");
  const auto shape = registries.surfaces.create(entry, {registries.surfaces, registries.contours});
  surface_ = shape->surface();
  if (tip_height_ == 0) tip_height_ = shape->tip_height();
  if (properties_.volume == 0) properties_.volume = surface_->moments().volume;
  constexpr double coarse = 0.01;  // of its extent; [m] where it goes on for ever
  const double extent = surface_->bounds().extent();
  for (const Point& x : surface_->triangles(coarse * (std::isfinite(extent) ? extent : 1.0)).points)
    reach_ = std::max(reach_, length(minus(x, centre_)));
}

std::shared_ptr<const BodyMotion> RigidBody::read_motion(const Section& section, const Registry<BodyMotion>& motions) {
  std::shared_ptr<const BodyMotion> motion = motions.create(section);
  if (motion->released()) {
    if (dimension() == 3)
      section.fail("a body in space moves as prescribed; allowed: held, prescribed displacement, prescribed velocity",
                   "type");
    motion->released()->check_body(properties_, section);
    may_be_free_ = true;
  }
  if (contour_ && contour().extent() == ContourExtent::half && (motion->moves(0) || motion->turns()))
    section.fail("a body with a half contour cannot leave its axis: it has no motion in x");
  return motion;
}

int RigidBody::unknowns_per_body(Geometry geometry) {
  int count = 0;
  for (int direction = 0; direction < body_directions; ++direction) count += may_move(geometry, direction);
  return count;
}

void RigidBody::bind(const Space& space, int field, int index) {
  unknowns_.field = field;
  unknowns_.count = space.field(field).components;
  for (int direction = 0, k = 0; direction < body_directions; ++direction)
    if (may_move(properties_.geometry, direction)) unknowns_.direction[k++] = direction;
  if (properties_.mass > 0 && properties_.moment_of_inertia > 0)
    unknowns_.scale[2] = std::sqrt(properties_.mass / properties_.moment_of_inertia);
  for (int k = 0; k < unknowns_.count; ++k) unknowns_.dof[k] = space.point_dof(field, index) + k;
  unknowns_.owned = unknowns_.dof[0] < space.dofs()->num_owned_dofs();
}

void RigidBody::declare_state(StateStore& store) {
  ArrayInfo info;
  info.name = "body/" + name_ + "/motion";
  for (int i = 0; i < dimension(); ++i)
    info.variables.push_back({std::string("displacement ") + axis_names[i], 1, "m"});
  for (int i = 0; i < dimension(); ++i) info.variables.push_back({std::string("velocity ") + axis_names[i], 1, "m/s"});
  info.variables.push_back({"moving time", 1, "s"});
  for (int i = 0; i < 3 && dimension() == 3; ++i)
    info.variables.push_back({std::string("rotation ") + axis_names[i], 1, "rad"});
  for (int i = 0; i < 3 && dimension() == 3; ++i)
    info.variables.push_back({std::string("spin ") + axis_names[i], 1, "rad/s"});
  array_ = store.find(info.name);
  if (array_ < 0) array_ = store.declare(std::move(info), 1);
}

bool RigidBody::set_motion(std::shared_ptr<const BodyMotion> motion) {
  std::swap(motion_, motion);
  return motion_ != motion;
}

void RigidBody::restart_clock(State& committed) const { committed.arrays[array_](0, 2 * dimension()) = 0; }

BodyState RigidBody::state_of(const State& state) const {
  const PointView& row = state.arrays[array_];
  const int axes = dimension();
  BodyState result;
  result.moving_time = row(0, 2 * axes);
  for (int i = 0; i < axes; ++i) {
    result.displacement[i] = row(0, i);
    result.velocity[i] = row(0, axes + i);
  }
  if (axes == 3) {
    result.turn = Rotation::by({row(0, 7), row(0, 8), row(0, 9)});
    result.spin = {row(0, 10), row(0, 11), row(0, 12)};
  }
  for (int k = 0; k < unknowns_.count; ++k) {
    const int direction = unknowns_.direction[k], dof = unknowns_.dof[k];
    if (direction < 2) {
      result.displacement[direction] = state.value(dof);
      result.velocity[direction] = state.rate(dof);
    } else {
      result.turn = Rotation::by({0, 0, state.value(dof) * unknowns_.scale[k]});
      result.spin[2] = state.rate(dof) * unknowns_.scale[k];
    }
  }
  return result;
}

BodyState RigidBody::prescribed(const State& committed, double t_old, double t_end) const {
  BodyState now = state_of(committed);
  if (motion_) return motion_->advance(now, t_old, t_end);
  now.velocity = now.spin = {};
  now.moving_time = 0;
  return now;
}

void RigidBody::prescribe(const State& committed, double t_old, double t_end, Constraints& to) const {
  const BodyState end = prescribed(committed, t_old, t_end);
  for (int k = 0; k < unknowns_.count; ++k) {
    const int dof = unknowns_.dof[k], direction = unknowns_.direction[k];
    const bool turns = direction > 1;
    if (!releases(direction))
      to.prescribe(dof, turns ? committed.value(dof) : end.displacement[direction],
                   turns ? 0 : end.velocity[direction]);
  }
}

void RigidBody::advance(const StepView& view) const {
  const BodyState now = prescribed(*view.committed, view.time_old, view.time_end);
  const PointView& row = view.trial->arrays[array_];
  const int axes = dimension();
  row(0, 2 * axes) = now.moving_time;
  if (unknowns_.count > 0) return;
  const Point turned = now.turn.vector();
  for (int i = 0; i < axes; ++i) {
    row(0, i) = now.displacement[i];
    row(0, axes + i) = now.velocity[i];
    if (axes < 3) continue;
    row(0, 7 + i) = turned[i];
    row(0, 10 + i) = now.spin[i];
  }
}

double RigidBody::speed(const State& state, double dt) const {
  if (!active() || !(dt > 0)) return 0;
  if (released()) {
    // where it stands, or at the end of the step with the acceleration it has; a rotation moves the contour's far end
    double now[2] = {0, 0}, then[2] = {0, 0}, spin = 0;
    for (int k = 0; k < unknowns_.count; ++k) {
      const int direction = unknowns_.direction[k];
      const double v = state.rate(unknowns_.dof[k]) * unknowns_.scale[k],
                   a = state.acceleration(unknowns_.dof[k]) * unknowns_.scale[k];
      if (direction == 2) {
        spin = std::max(std::abs(v), std::abs(v + a * dt));
        continue;
      }
      now[direction] = v;
      then[direction] = v + a * dt;
    }
    return std::max(std::hypot(now[0], now[1]), std::hypot(then[0], then[1])) + spin * reach_;
  }
  constexpr int parts = 8;
  BodyState at = state_of(state);
  double fastest = 0;
  for (int i = 0; i < parts; ++i) {
    const double from = state.time + dt * i / parts, to = state.time + dt * (i + 1) / parts;
    const BodyState next = motion_->advance(at, from, to);
    const double path =
        length(minus(next.displacement, at.displacement)) + reach_ * length((next.turn * at.turn.inverse()).vector());
    fastest = std::max(fastest, path / (to - from));
    at = next;
  }
  return fastest;
}

BodyPlacement RigidBody::initial_placement() const { return {plus(position_, 1, centre_), {}}; }

BodyPlacement RigidBody::placement(const State& state) const {
  const BodyState now = state_of(state);
  return {plus(initial_placement().centre, 1, now.displacement), now.turn};
}

Point RigidBody::position(const State& state) const {
  const BodyPlacement at = placement(state);
  return plus(at.centre, 1, arm(at));
}

Point RigidBody::displacement(const State& state) const {
  const BodyState now = state_of(state);
  return plus(plus(now.displacement, 1, centre_), -1, now.turn(centre_));
}

Point RigidBody::velocity(const State& state) const {
  const BodyState now = state_of(state);
  return plus(now.velocity, -1, cross(now.spin, now.turn(centre_)));
}

Point RigidBody::in_frame(const BodyPlacement& placement, const Point& x) const {
  return plus(placement.turn.back(minus(x, placement.centre)), 1, centre_);
}

ContourFoot RigidBody::closest(const BodyPlacement& placement, const PlanePoint& x) const {
  const auto turned = [&](const PlanePoint& v) { return in_plane(placement.turn({v[0], v[1], 0})); };
  ContourFoot foot = contour().closest(in_plane(in_frame(placement, {x[0], x[1], 0})));
  const PlanePoint arm = turned({foot.foot[0] - centre_[0], foot.foot[1] - centre_[1]});
  for (int i = 0; i < 2; ++i) foot.foot[i] = placement.centre[i] + arm[i];
  foot.normal = turned(foot.normal);
  foot.tangent = turned(foot.tangent);
  return foot;
}

SurfaceFoot RigidBody::foot(const BodyPlacement& placement, const Point& x) const {
  return PlacedSurface{surface_, plus(placement.centre, 1, arm(placement)), placement.turn}.closest(x);
}

double RigidBody::gap(const BodyPlacement& placement, const Point& x) const {
  const Point own = in_frame(placement, x);
  return surface_ ? surface_->closest(own).gap : contour().closest(in_plane(own)).gap;
}

double RigidBody::height(const BodyPlacement& placement, const Point& x) const {
  return in_frame(placement, x)[dimension() - 1];
}

}  // namespace mudline
