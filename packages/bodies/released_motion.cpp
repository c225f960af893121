#include "bodies/released_motion.hpp"

#include <algorithm>
#include <cmath>

namespace mudline {

namespace {
const char* const direction_names[body_directions] = {"x", "y", "rotation"};
}

void ReleasedMotion::common_parameters(Parameters& p) {
  p.add("freedom", freedom_, "directions in which the body may move: x, y, rotation; the others rest");
  p.add("gravity", gravity_, "m/s2", "acceleration whose force on the mass is the body's weight");
  p.add("force x", force_[0], "N",
        "horizontal force on the body, a function of time and of the reference point's position");
  p.add("force y", force_[1], "N",
        "vertical force on the body, upwards positive; a function of time and of the reference point's position");
  p.add("moment", force_[2], "N m",
        "moment on the body about its centre of mass, counter-clockwise, a function of time");
  if (p.documenting()) return;
  for (const std::string& name : freedom_) {
    const auto* known = std::find(std::begin(direction_names), std::end(direction_names), name);
    if (known == std::end(direction_names))
      p.deck().fail("unknown direction '" + name + "'; known: x, y, rotation", "freedom");
    released_[known - std::begin(direction_names)] = true;
  }
  if (freedom_.empty()) p.deck().fail("a body without a free direction has the motion 'held'", "freedom");
}

BodyState ReleasedMotion::advance(const BodyState& old, double t_old, double t_end) const {
  BodyState now = old;
  for (int i = 0; i < 2; ++i)
    if (!released_[i]) now.velocity[i] = 0;
  now.moving_time += t_end - t_old;
  return now;
}

BodyLoad ReleasedMotion::load(const BodyProperties& body, const BodyInstant& at) const {
  BodyLoad result;
  const Point x{at.position[0], at.position[1], 0};
  for (int i = 0; i < body_directions; ++i) {
    const Function& function = force_[i];
    result.force[i] = function(at.time, x);
    if (i < 2) result.force[i] += body.mass * gravity_[i];
    if (function.is_constant()) continue;
    for (int j = 0; j < 2; ++j) {  // an expression has no derivative: differenced
      const double h = 1e-6 * std::max(1.0, std::abs(x[j]));
      Point plus = x, minus = x;
      plus[j] += h;
      minus[j] -= h;
      result.by_position[i][j] = (function(at.time, plus) - function(at.time, minus)) / (2 * h);
    }
  }
  return result;
}

void ReleasedMotion::check_body(const BodyProperties& body, const Section& section) const {
  const char* const forces[body_directions] = {"force x", "force y", "moment"};
  for (int i = 0; i < body_directions; ++i)
    if (releases(i) && !may_move(body.geometry, i))
      section.fail("an axisymmetric body moves along its axis only: its freedom is y", "freedom");
  for (int i = 0; i < body_directions; ++i)
    if (!releases(i) && !force_[i].is_zero())
      section.fail(
          std::string("the body does not move in this direction (its 'freedom' lacks ") + direction_names[i] + ")",
          forces[i]);
  if (releases(2) && body.mass > 0 && body.moment_of_inertia <= 0)
    section.fail("a body that may rotate needs a 'moment of inertia'", "freedom");
}

void BodyWater::parameters(Parameters& p) {
  p.add("density", density, "kg/m3", non_negative(), "of the water around the body; 0: no water");
  p.add("drag coefficient", drag, "-", non_negative(), "C_d of the drag 1/2 rho C_d A |v| v");
  p.add("drag area", area, "m2", non_negative(),
        "A of the drag; 0: the largest section of the contour across the vertical");
  p.add("added mass coefficient", added_mass, "-", non_negative(),
        "mass of water accelerated with the body over that of its volume");
  p.add("mudline", mudline, "m", any(),
        "height of the seabed: buoyancy and drag act on the volume above it; absent: on all of it");
  has_mudline = p.given("mudline");
}

void FreeMotion::parameters(Parameters& p) {
  common_parameters(p);
  p.add("initial velocity", initial_velocity_, "m/s",
        "velocity with which the body is set free; absent: the one it has");
  starts_ = p.given("initial velocity");
  p.section("water", water_, "buoyancy, drag and added mass");
}

bool FreeMotion::initial_velocity(std::array<double, 2>& velocity) const {
  if (starts_) velocity = initial_velocity_;
  return starts_;
}

BodyLoad FreeMotion::load(const BodyProperties& body, const BodyInstant& at) const {
  BodyLoad result = ReleasedMotion::load(body, at);
  if (water_.density == 0) return result;
  double share = 1, slope = 0;  // of the volume above the mudline, and d share / dy
  if (water_.has_mudline) {
    const double height = water_.mudline - at.position[1];
    share = 1 - body.enclosed->below(height) / body.volume;
    slope = body.enclosed->section(height) / body.volume;
    if (share <= 0) share = slope = 0;
  }
  const double displaced = water_.density * body.volume;
  const double area = water_.area > 0 ? water_.area : body.enclosed->frontal_area();
  const double factor = 0.5 * water_.density * water_.drag * area, speed = std::hypot(at.velocity[0], at.velocity[1]);
  for (int i = 0; i < 2; ++i) {
    result.force[i] -= share * (displaced * gravity_[i] + factor * speed * at.velocity[i]);
    result.by_position[i][1] -= slope * (displaced * gravity_[i] + factor * speed * at.velocity[i]);
    if (speed == 0) continue;
    result.by_velocity[i][i] -= share * factor * speed;
    for (int j = 0; j < 2; ++j) result.by_velocity[i][j] -= share * factor * at.velocity[i] * at.velocity[j] / speed;
  }
  return result;
}

void FreeMotion::check_body(const BodyProperties& body, const Section& section) const {
  ReleasedMotion::check_body(body, section);
  if (body.mass <= 0) section.fail("a free body needs a 'mass' greater than 0", "type");
  for (int i = 0; i < 2; ++i)
    if (!releases(i) && initial_velocity_[i] != 0)
      section.fail(
          std::string("the body does not move in this direction (its 'freedom' lacks ") + direction_names[i] + ")",
          "initial velocity");
  const Section water = section.section("water");
  if (water_.density == 0 && (water_.drag > 0 || water_.added_mass > 0 || water_.has_mudline))
    water.fail("there is no water: its 'density' is 0 or missing", water_.drag > 0      ? "drag coefficient"
                                                                   : water_.has_mudline ? "mudline"
                                                                                        : "added mass coefficient");
  if (water_.area > 0 && water_.drag == 0) water.fail("without a 'drag coefficient' it does nothing", "drag area");
  if (water_.density > 0 && body.volume <= 0)
    water.fail("the body's contour is open: its buoyancy needs a 'volume' of the body", "density");
  if (water_.has_mudline && releases(2))
    water.fail("a body that may rotate is wholly in the water: it takes no 'mudline'", "mudline");
}

}  // namespace mudline
