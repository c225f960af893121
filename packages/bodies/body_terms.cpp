#include "bodies/body_terms.hpp"

#include <algorithm>
#include <cmath>

namespace mudline {

namespace {

bool released(const RigidBody& body, int k) { return body.releases(body.unknowns().direction[k]); }

/// Loads of a released body; values and rates of its unknowns by overlap dof.
BodyLoad load(const RigidBody& body, double time, const ConstNodalView& value, const ConstNodalView& rate) {
  BodyInstant at{time, {body.initial_position()[0], body.initial_position()[1], 0}, {}};
  const BodyUnknowns& unknowns = body.unknowns();
  for (int k = 0; k < unknowns.count; ++k) {
    at.position[unknowns.direction[k]] += value(unknowns.dof[k]) * unknowns.scale[k];
    at.velocity[unknowns.direction[k]] = rate(unknowns.dof[k]) * unknowns.scale[k];
  }
  return body.released()->load(body.properties(), at);
}

BodyLoad load(const RigidBody& body, const StepView& view) {
  return load(body, view.momentum.time, view.value, view.velocity);
}

}  // namespace

void BodyPaths::begin(const StepView& view) {
  for (const auto& body : bodies_) body->advance(view);
}

double moving_mass(const RigidBody& body) {
  return body.properties().mass + (body.released() ? body.released()->added_mass(body.properties()) : 0.0);
}

void BodyTerm::sparsity(Assembler& assembler) {
  int rows = 0;
  for (const auto& body : bodies_) rows += body->unknowns().owned;
  Kokkos::View<int**, Kokkos::LayoutRight> dofs("body dofs", rows, bodies_.front()->unknowns().count);
  int row = 0;
  for (const auto& body : bodies_) {
    if (!body->unknowns().owned) continue;
    for (int k = 0; k < body->unknowns().count; ++k) dofs(row, k) = body->unknowns().dof[k];
    ++row;
  }
  group_ = assembler.add_group(dofs);
}

int BodyInertia::residual(const StepView& view, const ResidualView& f) {
  if (!view.inertia) return 0;
  for (const auto& body : bodies_) {
    const BodyUnknowns& unknowns = body->unknowns();
    for (int k = 0; unknowns.owned && k < unknowns.count; ++k)
      f.add(unknowns.dof[k], moving_mass(*body) * view.acceleration(unknowns.dof[k]));
  }
  return 0;
}

void BodyInertia::jacobian(const StepView& view, Assembler& assembler, double weight) {
  if (!view.inertia) return;
  const MatrixScatter to = assembler.scatter(group_);
  int row = 0;
  for (const auto& body : bodies_) {
    const BodyUnknowns& unknowns = body->unknowns();
    if (!unknowns.owned) continue;
    for (int k = 0; k < unknowns.count; ++k)
      to.add(row, k, k, weight * moving_mass(*body) * view.sensitivity[unknowns.field].acceleration);
    ++row;
  }
}

void BodyInertia::histories(const StepView& view, Report& values) {
  const State& state = *view.committed;
  for (const auto& body : bodies_) {
    const BodyUnknowns& unknowns = body->unknowns();
    const std::string name = "body/" + body->name() + "/";
    double kinetic = 0;
    for (int k = 0; k < unknowns.count; ++k) {
      const int dof = unknowns.dof[k], direction = unknowns.direction[k];
      kinetic += 0.5 * moving_mass(*body) * state.rate(dof) * state.rate(dof);
      const double acceleration = state.acceleration(dof) * unknowns.scale[k];
      if (direction < 2) {
        values[name + "acceleration " + (direction == 0 ? "x" : "y")] = {"m/s2", acceleration};
        continue;
      }
      values[name + "rotation"] = {"rad", state.value(dof) * unknowns.scale[k]};
      values[name + "spin"] = {"rad/s", state.rate(dof) * unknowns.scale[k]};
    }
    values[name + "kinetic energy"] = {"J", kinetic};
  }
}

int BodyLoads::residual(const StepView& view, const ResidualView& f) {
  for (const auto& body : bodies_) {
    const BodyUnknowns& unknowns = body->unknowns();
    if (!body->released() || !unknowns.owned) continue;
    const BodyLoad acting = load(*body, view), old = load(*body, view.time_old, view.value_old, view.committed->rate);
    for (int k = 0; k < unknowns.count; ++k) {
      const int direction = unknowns.direction[k];
      const double force = acting.force[direction] * unknowns.scale[k];
      f.add(unknowns.dof[k], -force, old.force[direction] * unknowns.scale[k] - force);
    }
  }
  return 0;
}

void BodyLoads::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const MatrixScatter to = assembler.scatter(group_);
  int row = 0;
  for (const auto& body : bodies_) {
    const BodyUnknowns& unknowns = body->unknowns();
    if (!unknowns.owned) continue;
    if (body->released()) {
      const BodyLoad acting = load(*body, view);
      const Sensitivity& by = view.sensitivity[unknowns.field];
      for (int a = 0; a < unknowns.count; ++a)
        for (int b = 0; b < unknowns.count; ++b) {
          const int i = unknowns.direction[a], j = unknowns.direction[b];
          const double slope = acting.by_position[i][j] * by.value + acting.by_velocity[i][j] * by.velocity;
          to.add(row, a, b, -weight * slope * unknowns.scale[a] * unknowns.scale[b]);
        }
    }
    ++row;
  }
}

void BodyLoads::histories(const StepView& view, Report& values) {
  const State& state = *view.committed;
  const char* names[body_directions] = {"load x", "load y", "load moment"};
  for (const auto& body : bodies_) {
    const BodyUnknowns& unknowns = body->unknowns();
    const BodyLoad acting = body->released() ? load(*body, state.time, state.value, state.rate) : BodyLoad();
    for (int k = 0; k < unknowns.count; ++k)
      values["body/" + body->name() + "/" + names[unknowns.direction[k]]] = {unknowns.direction[k] < 2 ? "N" : "N m",
                                                                             acting.force[unknowns.direction[k]]};
  }
}

void set_free(const RigidBody& body, State& committed, const NodalView& unbalanced, bool anew) {
  const BodyUnknowns& unknowns = body.unknowns();
  const ReleasedMotion& motion = *body.released();
  std::array<double, 2> start{};
  const bool starts = anew && motion.initial_velocity(start);
  for (int k = 0; k < unknowns.count; ++k) {
    double& v = committed.rate(unknowns.dof[k]);
    if (!released(body, k))
      v = 0;
    else if (starts)
      v = unknowns.direction[k] < 2 ? start[unknowns.direction[k]] : 0.0;
  }
  // the residual at rest lacks what the velocity adds to the loads
  const BodyLoad moving = load(body, committed.time, committed.value, committed.rate);
  const BodyLoad resting = load(body, committed.time, committed.value, NodalView("rest", committed.rate.extent(0)));
  for (int k = 0; k < unknowns.count; ++k) {
    const int dof = unknowns.dof[k], direction = unknowns.direction[k];
    const double drag = (moving.force[direction] - resting.force[direction]) * unknowns.scale[k];
    committed.acceleration(dof) = released(body, k) ? (drag - unbalanced(dof)) / moving_mass(body) : 0.0;
  }
}

}  // namespace mudline
