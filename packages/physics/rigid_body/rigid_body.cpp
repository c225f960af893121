#include "physics/rigid_body/rigid_body.hpp"

#include <algorithm>
#include <cmath>

namespace mudline {

void RigidBody::parameters(Parameters& p) {
  p.add("position", position_, "m", "Where the body's reference point (the tip of its contour) is before any motion");
  p.passes_on("contour", "Shape of the body; 'type' names a contour");
  p.passes_on("motion", "How the body moves; 'type' names a motion");
}

std::shared_ptr<RigidBody> RigidBody::read(const Section& section, Geometry geometry,
                                           const BodyRegistries& registries) {
  std::shared_ptr<RigidBody> body(new RigidBody);
  body->name_ = section.name();
  Parameters p(section);
  body->parameters(p);
  p.finish();
  const Section contour = section.section("contour"), motion = section.section("motion");
  body->contour_ = std::make_unique<Contour>(registries.contours.create(contour)->build());
  body->motion_ = registries.motions.create(motion);
  const bool half = body->contour().extent() == ContourExtent::half;
  if (geometry == Geometry::axisymmetric && !half)
    contour.fail("an axisymmetric body has a half contour, not a full one", "extent");
  if (geometry == Geometry::axisymmetric && body->position_[0] != 0)
    section.fail("the axis of an axisymmetric body is r = 0: the first value must be 0", "position");
  if (half && body->motion_->lateral())
    motion.fail("a body with a half contour cannot leave its axis: it has no motion in x");
  return body;
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

BodyState RigidBody::body_state(const State& state) const {
  const PointView& row = state.arrays[array_];
  return {{row(0, 0), row(0, 1)}, {row(0, 2), row(0, 3)}, row(0, 4)};
}

void RigidBody::advance(const StepView& view) const {
  BodyState now = body_state(*view.committed);
  if (active_) {
    now = motion_->advance(now, view.time_old, view.time_end);
  } else {
    now.velocity = {0, 0};
    now.moving_time = 0;
  }
  const PointView& row = view.trial->arrays[array_];
  for (int i = 0; i < 2; ++i) {
    row(0, i) = now.displacement[i];
    row(0, 2 + i) = now.velocity[i];
  }
  row(0, 4) = now.moving_time;
}

double RigidBody::speed(const State& state, double dt) const {
  if (!active_ || !(dt > 0)) return 0;
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

std::array<double, 2> RigidBody::displacement(const State& state) const { return body_state(state).displacement; }

std::array<double, 2> RigidBody::velocity(const State& state) const { return body_state(state).velocity; }

std::array<double, 2> RigidBody::position(const State& state) const {
  const auto u = displacement(state);
  return {position_[0] + u[0], position_[1] + u[1]};
}

ContourFoot RigidBody::closest(const std::array<double, 2>& position, const PlanePoint& x) const {
  ContourFoot foot = contour().closest({x[0] - position[0], x[1] - position[1]});
  for (int i = 0; i < 2; ++i) foot.foot[i] += position[i];
  return foot;
}

std::vector<PlanePoint> RigidBody::sample(const State& state, double chord_error) const {
  const auto origin = position(state);
  auto points = contour().sample(chord_error);
  for (auto& point : points)
    for (int i = 0; i < 2; ++i) point[i] += origin[i];
  return points;
}

void register_rigid_body(Registry<ContourShape>& contours, Registry<BodyMotion>& motions) {
  register_contours(contours);
  register_motions(motions);
}

}  // namespace mudline
