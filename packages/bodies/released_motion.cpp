#include "bodies/released_motion.hpp"

#include <algorithm>
#include <cmath>

namespace mudline {

void ReleasedMotion::common_parameters(Parameters& p) {
  dimension_ = p.dimension();
  const bool space = dimension_ == 3;
  if (space && !p.documenting()) freedom_ = {"x", "y", "z", "rotation x", "rotation y", "rotation z"};
  p.add("freedom", freedom_,
        "directions in which the body may move; the others rest, or move as 'prescribed velocity' says. In the plane: "
        "x, y, rotation; in space: x, y, z, and rotation x, rotation y, rotation z about the body's own axes, by "
        "default all");
  p.add("gravity", gravity_, "m/s2",
        "acceleration whose force on the mass is the body's weight; of a free body 9.81 m/s2 downwards by default");
  p.add("force x", force_[0], "N",
        "horizontal force on the body, a function of time and of the reference point's position");
  p.add("force y", force_[1], "N",
        "force on the body, in the plane vertical, upwards positive; a function of time and of the reference point's "
        "position");
  if (space) p.add("force z", force_[2], "N", "in space: vertical force on the body, upwards positive; likewise");
  if (!space || p.documenting())
    p.add("moment", moment_[2], "N m",
          "in the plane: moment on the body about its centre of mass, counter-clockwise, a function of time");
  if (space)
    for (int i = 0; i < 3; ++i)
      p.add(
          std::string("moment ") + axis_names[i], moment_[i], "N m",
          std::string("in space: moment on the body about the ") + axis_names[i] + " axis through its centre of mass");
  p.passes_on("loads", "Forces and moments at points of the body (an eye, a line), by name; see the loads of a body");
  p.section("prescribed velocity", others_, "how the body moves in the directions that its freedom lacks");
  if (p.documenting()) return;
  read_freedom(p);
  read_loads(p);
}

void ReleasedMotion::read_freedom(Parameters& p) {
  const int count = dimension_ == 2 ? 3 : 6;
  std::string known;
  for (int i = 0; i < count; ++i) known += (i > 0 ? ", " : "") + std::string(direction_name(dimension_, i));
  for (const std::string& name : freedom_) {
    int direction = 0;
    while (direction < count && name != direction_name(dimension_, direction)) ++direction;
    if (direction == count) p.deck().fail("unknown direction '" + name + "'; known: " + known, "freedom");
    released_[direction] = true;
  }
  if (freedom_.empty()) p.deck().fail("a body without a free direction has the motion 'held'", "freedom");
}

void ReleasedMotion::read_loads(Parameters& p) {
  const Section entries = p.deck().section("loads");
  entries.allow_parameters({});
  for (const std::string& name : entries.section_names()) {
    Parameters own(entries.section(name));
    loads_.emplace_back();
    loads_.back().parameters(own);
    own.finish();
  }
}

bool ReleasedMotion::rotates() const {
  return std::any_of(released_ + dimension_, released_ + body_directions, [](bool free) { return free; });
}

BodyState ReleasedMotion::advance(const BodyState& old, double t_old, double t_end) const {
  BodyState now = others_.advance(old, t_old, t_end);
  if (!others_.turns()) now.spin = {};
  for (int i = 0; i < dimension_; ++i)
    if (released_[i]) {
      now.displacement[i] = old.displacement[i];
      now.velocity[i] = old.velocity[i];
    }
  return now;
}

BodyLoad ReleasedMotion::load(const BodyProperties& body, const BodyInstant& now) const {
  BodyLoad result;
  const auto vector = [&](const Function(&f)[3]) {
    BodyVector v;
    for (int i = 0; i < 3; ++i) v[i] = at(f[i], now.time, now.position, dimension_);
    return v;
  };
  result.force = vector(force_) + constant_vector(body.mass * gravity_);
  result.moment = vector(moment_);
  for (const PointLoad& load : loads_) {
    const BodyVector arm = now.axes.outward(constant_vector(load.point - body.centre));
    const BodyVector force = vector(load.force), moment = vector(load.moment);
    result.add(load.turns ? now.axes.outward(force) : force, arm);
    result.moment = result.moment + (load.turns ? now.axes.outward(moment) : moment);
  }
  return result;
}

void ReleasedMotion::refuse(const Section& section, int direction, const std::string& entry) const {
  section.fail(std::string("the body does not move in this direction (its 'freedom' lacks ") +
                   direction_name(dimension_, direction) + ")",
               entry);
}

void ReleasedMotion::check_body(const BodyProperties& body, const Section& section) const {
  for (int i = 0; i < num_directions(body.geometry); ++i)
    if (releases(i) && !may_move(body.geometry, i))
      section.fail("an axisymmetric body moves along its axis only: its freedom is y", "freedom");
  for (int i = 0; i < dimension_; ++i)
    if (!releases(i) && !force_[i].is_zero()) refuse(section, i, std::string("force ") + axis_names[i]);
  // about the model's axes: any rotation of a body in space may answer
  if (!rotates())
    for (int axis = 0; axis < 3; ++axis)
      if (!moment_[axis].is_zero())
        refuse(section, dimension_ == 2 ? 2 : 3 + axis,
               dimension_ == 2 ? "moment" : std::string("moment ") + axis_names[axis]);
  check_others(section);
  if (!rotates() || body.mass <= 0) return;
  if (dimension_ == 2 && body.moment_of_inertia <= 0)
    section.fail("a body that may rotate needs a 'moment of inertia'", "freedom");
  if (dimension_ == 3 && body.inertia[0][0] + body.inertia[1][1] + body.inertia[2][2] <= 0)
    section.fail("the body's surface is open: a body that may rotate needs an 'inertia tensor'", "freedom");
}

void ReleasedMotion::check_others(const Section& section) const {
  const Section own = section.section("prescribed velocity");
  for (int i = 0; i < dimension_; ++i)
    if (releases(i) && others_.moves(i))
      own.fail("the body moves freely in this direction", std::string("velocity ") + axis_names[i]);
  if (dimension_ == 2 || !others_.turns()) return;
  if (releases(3) && releases(4) && releases(5))
    own.fail("the body rotates freely about all of its axes: it takes no prescribed spin");
}

void FreeMotion::parameters(Parameters& p) {
  gravity_[p.dimension() - 1] = -9.81;
  common_parameters(p);
  p.add("initial velocity", initial_velocity_, "m/s",
        "velocity with which the body is set free; absent: the one it has");
  starts_ = p.given("initial velocity");
  if (p.dimension() == 3) {
    p.add("initial spin", initial_spin_, "rad/s",
          "in space: spin about the model's axes with which the body is set free; absent: the one it has");
    starts_ = starts_ || p.given("initial spin");
  }
  p.section("water", water_, "buoyancy, drag and added mass");
}

bool FreeMotion::initial_velocity(Point& velocity, Point& spin) const {
  if (!starts_) return false;
  velocity = initial_velocity_;
  spin = initial_spin_;
  return true;
}

BodyLoad FreeMotion::load(const BodyProperties& body, const BodyInstant& at) const {
  BodyLoad result = ReleasedMotion::load(body, at);
  water_.act(body, gravity_, at, result);
  return result;
}

void FreeMotion::check_body(const BodyProperties& body, const Section& section) const {
  ReleasedMotion::check_body(body, section);
  if (body.mass <= 0) section.fail("a free body needs a 'mass' greater than 0", "type");
  for (int i = 0; i < dimension_; ++i)
    if (!releases(i) && initial_velocity_[i] != 0) refuse(section, i, "initial velocity");
  if (!rotates() && length(initial_spin_) > 0) refuse(section, 3, "initial spin");
  water_.check(body, rotates(), section.section("water"));
}

}  // namespace mudline
