#include "bodies/body_terms.hpp"

#include <algorithm>
#include <cmath>

#include "tensor/small_lu.hpp"

namespace mudline {

void BodyPaths::begin(const StepView& view) {
  for (const auto& body : bodies_) body->advance(view);
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

template <class Forces>
void BodyTerm::add_slopes(const MatrixScatter& to, double weight, const Forces& forces) const {
  int row = 0;
  for (const auto& body : bodies_) {
    const int count = body->unknowns().count;
    if (!body->unknowns().owned) continue;
    BodyNumber force[body_directions];
    if (forces(*body, force))
      for (int a = 0; a < count; ++a)
        for (int b = 0; b < count; ++b) to.add(row, a, b, weight * force[a].d[b]);
    ++row;
  }
}

int BodyInertia::residual(const StepView& view, const ResidualView& f) {
  if (!view.inertia) return 0;
  for (const auto& body : bodies_) {
    const BodyUnknowns& unknowns = body->unknowns();
    if (!unknowns.owned) continue;
    const BodyInertiaForce force(*body, BodyLevel(*body, view));
    for (int k = 0; k < unknowns.count; ++k) f.add(unknowns.dof[k], force[k].v);
  }
  return 0;
}

void BodyInertia::jacobian(const StepView& view, Assembler& assembler, double weight) {
  if (!view.inertia) return;
  add_slopes(assembler.scatter(group_), weight, [&](const RigidBody& body, BodyNumber* force) {
    const BodyInertiaForce inertia(body, BodyLevel(body, view));
    for (int k = 0; k < body.unknowns().count; ++k) force[k] = inertia[k];
    return true;
  });
}

void BodyInertia::histories(const StepView& view, Report& values) {
  const State& state = *view.committed;
  for (const auto& body : bodies_) {
    const BodyUnknowns& unknowns = body->unknowns();
    const std::string name = "body/" + body->name() + "/";
    const int axes = body->dimension();
    for (int k = 0; k < unknowns.count; ++k) {
      const int dof = unknowns.dof[k], direction = unknowns.direction[k];
      if (direction < axes) {
        values[name + "acceleration " + axis_names[direction]] = {"m/s2", state.acceleration(dof) * unknowns.scale[k]};
      } else if (axes == 2) {
        values[name + "rotation"] = {"rad", state.value(dof) * unknowns.scale[k]};
        values[name + "spin"] = {"rad/s", state.rate(dof) * unknowns.scale[k]};
      }
    }
    const BodyMomentum now = momentum(*body, state);
    values[name + "kinetic energy"] = {"J", now.kinetic};
    if (axes == 3)
      for (int i = 0; i < 3; ++i) values[name + "angular momentum " + axis_names[i]] = {"N m s", now.angular[i]};
  }
}

int BodyLoads::residual(const StepView& view, const ResidualView& f) {
  for (const auto& body : bodies_) {
    const BodyUnknowns& unknowns = body->unknowns();
    if (!body->released() || !unknowns.owned) continue;
    const BodyLevel now(*body, view);
    BodyLevel before(*body, *view.committed, view.committed->rate);
    before.at.time = view.time_old;
    const BodyLoad acting = load(*body, now), old = load(*body, before);
    for (int k = 0; k < unknowns.count; ++k) {
      const double force = generalised(*body, now, acting, k).v;
      f.add(unknowns.dof[k], -force, generalised(*body, before, old, k).v - force);
    }
  }
  return 0;
}

void BodyLoads::jacobian(const StepView& view, Assembler& assembler, double weight) {
  add_slopes(assembler.scatter(group_), -weight, [&](const RigidBody& body, BodyNumber* force) {
    if (!body.released()) return false;
    const BodyLevel now(body, view);
    const BodyLoad acting = load(body, now);
    for (int k = 0; k < body.unknowns().count; ++k) force[k] = generalised(body, now, acting, k);
    return true;
  });
}

void BodyLoads::histories(const StepView& view, Report& values) {
  const State& state = *view.committed;
  for (const auto& body : bodies_) {
    const BodyUnknowns& unknowns = body->unknowns();
    const int axes = body->dimension();
    const BodyLoad acting = body->released() ? load(*body, BodyLevel(*body, state, state.rate)) : BodyLoad();
    for (int k = 0; k < unknowns.count; ++k) {
      const int direction = unknowns.direction[k];
      const bool turns = direction >= axes;
      const std::string axis = turns && axes == 2 ? "" : " " + std::string(axis_names[direction % axes]);
      values["body/" + body->name() + (turns ? "/load moment" : "/load") + axis] = {turns ? "N m" : "N",
                                                                                    along(acting, axes, direction).v};
    }
  }
}

namespace {

/// Solves the equations of motion of the released directions for the accelerations of the state; `force` by unknown.
void accelerate(const RigidBody& body, State& state, const double* force) {
  const BodyUnknowns& unknowns = body.unknowns();
  for (int k = 0; k < unknowns.count; ++k) state.acceleration(unknowns.dof[k]) = 0;
  // at rest in acceleration what the motion itself takes, and its derivatives the masses
  const BodyInertiaForce inertia(body, BodyLevel(body, state, state.rate, {0, 0, 0, 1}));
  SmallLu<body_directions> masses;
  double right[body_directions] = {};
  for (int a = 0; a < body_directions; ++a) {
    const bool moves = a < unknowns.count && body.releases(unknowns.direction[a]);
    for (int b = 0; b < body_directions; ++b) {
      const bool both = moves && b < unknowns.count && body.releases(unknowns.direction[b]);
      masses.a[a][b] = both ? inertia[a].d[b] : (a == b ? 1.0 : 0.0);
    }
    if (moves) right[a] = force[a] - inertia[a].v;
  }
  if (!masses.factorise()) return;
  masses.solve(right);
  for (int k = 0; k < unknowns.count; ++k) state.acceleration(unknowns.dof[k]) = right[k];
}

}  // namespace

void set_free(const RigidBody& body, State& committed, const NodalView& unbalanced, bool anew) {
  const BodyUnknowns& unknowns = body.unknowns();
  const int axes = body.dimension();
  Point start{}, spin{};
  const bool starts = anew && body.released()->initial_velocity(start, spin);
  const BodyState now = body.state_of(committed), given = body.prescribed(committed, committed.time, committed.time);
  const Point started = now.turn.back(spin), turning = now.turn.back(given.spin);
  for (int k = 0; k < unknowns.count; ++k) {
    const int direction = unknowns.direction[k];
    const bool turns = direction >= axes, in_plane = axes == 2;
    const int axis = turns ? axis_of_rotation(axes, direction) : direction;
    double& v = committed.rate(unknowns.dof[k]);
    if (!body.releases(direction))
      v = (turns ? (in_plane ? 0.0 : turning[axis]) : given.velocity[axis]) / unknowns.scale[k];
    else if (starts)
      v = (turns ? started[axis] : start[axis]) / unknowns.scale[k];
  }
  // the residual at rest lacks what the velocity adds to the loads
  const BodyLevel moving(body, committed, committed.rate),
      resting(body, committed, NodalView("rest", committed.rate.extent(0)));
  const BodyLoad with = load(body, moving), without = load(body, resting);
  double force[body_directions] = {};
  for (int k = 0; k < unknowns.count; ++k)
    force[k] =
        generalised(body, moving, with, k).v - generalised(body, resting, without, k).v - unbalanced(unknowns.dof[k]);
  accelerate(body, committed, force);
}

}  // namespace mudline
