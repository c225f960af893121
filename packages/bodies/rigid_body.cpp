#include "bodies/rigid_body.hpp"

#include "core/guarded.hpp"

#include <algorithm>
#include <cmath>

namespace mudline {

namespace {

PlanePoint turned(double angle, const PlanePoint& v) {
  if (angle == 0) return v;  // bodies that do not rotate keep every bit
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v[0] - s * v[1], s * v[0] + c * v[1]};
}

}  // namespace

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
  p.passes_on("contour", "Shape of the body; 'type' names a contour");
  p.passes_on("motion", "How the body moves, unless a stage says otherwise; 'type' names a motion");
}

std::shared_ptr<RigidBody> RigidBody::read(const Section& section, Geometry geometry,
                                           const BodyRegistries& registries) {
  std::shared_ptr<RigidBody> body(new RigidBody);
  body->name_ = section.name();
  Parameters p(section);
  body->parameters(p);
  p.finish();
  const Section contour = section.section("contour");
  const auto shape = registries.contours.create(contour);
  body->contour_ = std::make_unique<Contour>(shape->contour(contour));
  body->of_revolution_ = shape->of_revolution();
  body->enclosed_ = std::make_unique<ContourVolume>(body->contour(), geometry);
  if (body->tip_height_ == 0) body->tip_height_ = shape->tip_height();
  const bool half = body->contour().extent() == ContourExtent::half;
  if (geometry == Geometry::axisymmetric && !half)
    contour.fail("an axisymmetric body has a half contour, not a full one", "extent");
  if (geometry == Geometry::axisymmetric && body->position_[0] != 0)
    section.fail("the axis of an axisymmetric body is r = 0: the first value must be 0", "position");
  if (half && body->centre_[0] != 0)
    section.fail("the centre of mass of a body with a half contour is on its axis: the first value must be 0",
                 "centre of mass");
  BodyProperties& properties = body->properties_;
  properties.geometry = geometry;
  properties.enclosed = body->enclosed_.get();
  if (properties.volume == 0) properties.volume = body->enclosed_->total();
  body->own_motion_ = body->motion_ = body->read_motion(section.section("motion"), registries.motions);
  return body;
}

std::shared_ptr<const BodyMotion> RigidBody::read_motion(const Section& section, const Registry<BodyMotion>& motions) {
  std::shared_ptr<const BodyMotion> motion = motions.create(section);
  if (motion->released()) {
    motion->released()->check_body(properties_, section);
    may_be_free_ = true;
  }
  if (contour().extent() == ContourExtent::half && motion->lateral())
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
  info.variables = {{"displacement x", 1, "m"},
                    {"displacement y", 1, "m"},
                    {"velocity x", 1, "m/s"},
                    {"velocity y", 1, "m/s"},
                    {"moving time", 1, "s"}};
  array_ = store.find(info.name);
  if (array_ < 0) array_ = store.declare(std::move(info), 1);
}

bool RigidBody::set_motion(std::shared_ptr<const BodyMotion> motion) {
  std::swap(motion_, motion);
  return motion_ != motion;
}

void RigidBody::restart_clock(State& committed) const { committed.arrays[array_](0, 4) = 0; }

BodyState RigidBody::body_state(const State& state) const {
  const PointView& row = state.arrays[array_];
  BodyState result{{row(0, 0), row(0, 1)}, {row(0, 2), row(0, 3)}, row(0, 4)};
  for (int k = 0; k < unknowns_.count; ++k) {
    const int direction = unknowns_.direction[k];
    if (direction > 1) continue;
    result.displacement[direction] = state.value(unknowns_.dof[k]);
    result.velocity[direction] = state.rate(unknowns_.dof[k]);
  }
  return result;
}

BodyState RigidBody::prescribed(const State& committed, double t_old, double t_end) const {
  BodyState now = body_state(committed);
  if (motion_) return motion_->advance(now, t_old, t_end);
  now.velocity = {0, 0};
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
  row(0, 4) = now.moving_time;
  if (unknowns_.count > 0) return;
  for (int i = 0; i < 2; ++i) {
    row(0, i) = now.displacement[i];
    row(0, 2 + i) = now.velocity[i];
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
    return std::max(std::hypot(now[0], now[1]), std::hypot(then[0], then[1])) + 0.5 * spin * contour().length();
  }
  constexpr int parts = 8;
  BodyState at = body_state(state);
  double fastest = 0;
  for (int i = 0; i < parts; ++i) {
    const double from = state.time + dt * i / parts, to = state.time + dt * (i + 1) / parts;
    const BodyState next = motion_->advance(at, from, to);
    const double path =
        std::hypot(next.displacement[0] - at.displacement[0], next.displacement[1] - at.displacement[1]);
    fastest = std::max(fastest, path / (to - from));
    at = next;
  }
  return fastest;
}

BodyPlacement RigidBody::initial_placement() const {
  return {{position_[0] + centre_[0], position_[1] + centre_[1]}, 0};
}

BodyPlacement RigidBody::placement(const State& state) const {
  const auto u = body_state(state).displacement;
  BodyPlacement result = initial_placement();
  for (int i = 0; i < 2; ++i) result.centre[i] += u[i];
  if (unknowns_.count == body_directions) result.angle = state.value(unknowns_.dof[2]) * unknowns_.scale[2];
  return result;
}

std::array<double, 2> RigidBody::position(const State& state) const {
  const BodyPlacement at = placement(state);
  const PlanePoint arm = turned(at.angle, centre_);
  return {at.centre[0] - arm[0], at.centre[1] - arm[1]};
}

std::array<double, 2> RigidBody::displacement(const State& state) const {
  auto u = body_state(state).displacement;
  const PlanePoint arm = turned(placement(state).angle, centre_);
  for (int i = 0; i < 2; ++i) u[i] += centre_[i] - arm[i];
  return u;
}

std::array<double, 2> RigidBody::velocity(const State& state) const {
  auto v = body_state(state).velocity;
  if (unknowns_.count < body_directions) return v;
  const PlanePoint arm = turned(placement(state).angle, centre_);
  const double spin = state.rate(unknowns_.dof[2]) * unknowns_.scale[2];
  return {v[0] + spin * arm[1], v[1] - spin * arm[0]};
}

PlanePoint RigidBody::in_frame(const BodyPlacement& placement, const PlanePoint& x) const {
  const PlanePoint arm = turned(-placement.angle, {x[0] - placement.centre[0], x[1] - placement.centre[1]});
  return {arm[0] + centre_[0], arm[1] + centre_[1]};
}

ContourFoot RigidBody::closest(const BodyPlacement& placement, const PlanePoint& x) const {
  ContourFoot foot = contour().closest(in_frame(placement, x));
  const PlanePoint arm = turned(placement.angle, {foot.foot[0] - centre_[0], foot.foot[1] - centre_[1]});
  for (int i = 0; i < 2; ++i) foot.foot[i] = placement.centre[i] + arm[i];
  foot.normal = turned(placement.angle, foot.normal);
  foot.tangent = turned(placement.angle, foot.tangent);
  return foot;
}

std::vector<PlanePoint> RigidBody::sample(const State& state, double chord_error) const {
  const BodyPlacement at = placement(state);
  auto points = contour().sample(chord_error);
  for (auto& point : points) {
    const PlanePoint arm = turned(at.angle, {point[0] - centre_[0], point[1] - centre_[1]});
    for (int i = 0; i < 2; ++i) point[i] = at.centre[i] + arm[i];
  }
  return points;
}

void register_rigid_body(Registry<ContourShape>& contours, Registry<BodyMotion>& motions) {
  register_contours(contours);
  register_motions(motions);
}

}  // namespace mudline
