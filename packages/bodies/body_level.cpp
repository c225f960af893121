#include "bodies/body_level.hpp"

namespace mudline {

namespace {

BodyNumber number(double value, int unknown, double slope) {
  BodyNumber result(value);
  result.d[unknown] = slope;
  return result;
}

AddedMass added_mass(const RigidBody& body) {
  return body.released() ? body.released()->added_mass(body.properties()) : AddedMass();
}

BodyVector by_axis(const Point& factor, const BodyVector& v) {
  return {factor[0] * v[0], factor[1] * v[1], factor[2] * v[2]};
}

/// Of the body and of the water that turns with it, along the body's axes.
BodyVector inertia_times(const RigidBody& body, const BodyVector& spin) {
  BodyVector result = by_axis(added_mass(body).inertia, spin);
  const auto& tensor = body.properties().inertia;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result[i] += tensor[i][j] * spin[j];
  return result;
}

}  // namespace

BodyLevel::BodyLevel(const RigidBody& body, const StepView& view) {
  const BodyUnknowns& unknowns = body.unknowns();
  const Sensitivity& by = view.sensitivity[unknowns.field];
  at.time = view.momentum.time;
  const Rotation start = body.initial_placement().turn;
  at.axes = BodyAxes(start);
  rates(body, view.velocity, view.acceleration, by);
  for (int k = 0; k < unknowns.count; ++k) {
    const int dof = unknowns.dof[k], direction = unknowns.direction[k];
    if (direction < body.dimension()) {
      at.position[direction] = number(view.value(dof), k, by.value);
    } else if (body.dimension() == 2) {
      const BodyNumber angle = number(view.value(dof), k, by.value) * unknowns.scale[k];
      const BodyNumber cosine = chain(angle, std::cos(angle.v), -std::sin(angle.v)),
                       sine = chain(angle, std::sin(angle.v), std::cos(angle.v));
      const double c0 = start.matrix[0][0], s0 = start.matrix[1][0];
      const BodyNumber c = cosine * c0 - sine * s0, s = sine * c0 + cosine * s0;
      at.axes.axis[0] = {c, s, BodyNumber(0.0)};
      at.axes.axis[1] = {-s, c, BodyNumber(0.0)};
    } else {
      const double change = view.value_end(dof) - view.value_old(dof);
      increment[direction - 3] = number(change, k, 1) * unknowns.scale[k];
    }
  }
  if (body.dimension() == 3) {
    // the mean of the axes at both ends: forces that are fixed in space then do the work that they should
    const BodyAxes old(body.state_of(*view.committed).turn);
    at.axes = old.turned_on(increment).mixed(by.value, old);
    between = by.value * (1 - by.value);
  }
  place(body);
}

BodyLevel::BodyLevel(const RigidBody& body, const State& state, const ConstNodalView& rate, const Sensitivity& by) {
  at.time = state.time;
  rates(body, rate, state.acceleration, by);
  const BodyState now = body.state_of(state);
  at.position = constant_vector(now.displacement);
  at.axes = BodyAxes(now.turn);
  place(body);
}

void BodyLevel::rates(const RigidBody& body, const ConstNodalView& rate, const ConstNodalView& change,
                      const Sensitivity& by) {
  const BodyUnknowns& unknowns = body.unknowns();
  for (int k = 0; k < unknowns.count; ++k) {
    const int dof = unknowns.dof[k], direction = unknowns.direction[k];
    const bool turns = direction >= body.dimension();
    const int axis = turns ? axis_of_rotation(body.dimension(), direction) : direction;
    arc_acceleration[k] = number(change(dof), k, by.acceleration);
    (turns ? at.spin : at.velocity)[axis] = number(rate(dof), k, by.velocity) * unknowns.scale[k];
    (turns ? spin_change : acceleration)[axis] = arc_acceleration[k] * unknowns.scale[k];
  }
}

void BodyLevel::place(const RigidBody& body) {
  at.position = at.position + constant_vector(body.initial_placement().centre) -
                at.axes.outward(constant_vector(body.properties().centre));
}

BodyLoad load(const RigidBody& body, const BodyLevel& level) {
  return body.released()->load(body.properties(), level.at);
}

BodyNumber generalised(const RigidBody& body, const BodyLevel& level, const BodyLoad& load, int k) {
  const int direction = body.unknowns().direction[k], axes = body.dimension();
  const double scale = body.unknowns().scale[k];
  if (direction < axes || axes == 2) return along(load, axes, direction) * scale;
  const BodyVector moment = level.at.axes.inward(load.moment), &turned = level.increment;
  // exactly the change of angular momentum in space where the level is the middle of the step
  return (moment - cross(turned, cross(turned, moment)) * level.between)[direction - 3] * scale;
}

BodyInertiaForce::BodyInertiaForce(const RigidBody& body, const BodyLevel& level) {
  if (body.dimension() == 3) in_space(body, level);
  if (body.dimension() == 2)
    for (int k = 0; k < body.unknowns().count; ++k) force_[k] = moving_mass(body) * level.arc_acceleration[k];
}

void BodyInertiaForce::in_space(const RigidBody& body, const BodyLevel& level) {
  const BodyUnknowns& unknowns = body.unknowns();
  const AddedMass added = added_mass(body);
  const BodyVector &spin = level.at.spin, v = level.at.axes.inward(level.at.velocity),
                   a = level.at.axes.inward(level.acceleration), water = by_axis(added.mass, v);
  // the water's momentum turns with the body
  const BodyVector dragged = by_axis(added.mass, a) + cross(spin, water) - by_axis(added.mass, cross(spin, v));
  const BodyVector force = level.acceleration * body.properties().mass + level.at.axes.outward(dragged);
  const BodyVector moment =
      inertia_times(body, level.spin_change) + cross(spin, inertia_times(body, spin)) + cross(v, water);
  for (int k = 0; k < unknowns.count; ++k) {
    const int direction = unknowns.direction[k];
    force_[k] = (direction < 3 ? force[direction] : moment[direction - 3]) * unknowns.scale[k];
  }
}

double moving_mass(const RigidBody& body) { return body.properties().mass + added_mass(body).mass[0]; }

BodyMomentum momentum(const RigidBody& body, const State& state) {
  BodyMomentum result;
  const BodyUnknowns& unknowns = body.unknowns();
  if (body.dimension() == 2) {
    for (int k = 0; k < unknowns.count; ++k) {
      const double v = state.rate(unknowns.dof[k]), mass = moving_mass(body);
      if (unknowns.direction[k] < 2)
        result.linear[unknowns.direction[k]] = mass * v;
      else
        result.angular[2] = mass * v / unknowns.scale[k];
      result.kinetic += 0.5 * mass * v * v;
    }
    return result;
  }
  const BodyInstant at = BodyLevel(body, state, state.rate).at;
  const BodyVector v = at.axes.inward(at.velocity), water = by_axis(added_mass(body).mass, v),
                   spun = inertia_times(body, at.spin);
  result.linear = plain_vector(at.velocity * body.properties().mass + at.axes.outward(water));
  result.angular = plain_vector(at.axes.outward(spun));
  result.kinetic =
      0.5 * (body.properties().mass * dot(at.velocity, at.velocity) + dot(v, water) + dot(at.spin, spun)).v;
  return result;
}

}  // namespace mudline
