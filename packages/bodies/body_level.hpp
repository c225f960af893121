#pragma once

#include "bodies/rigid_body.hpp"

namespace mudline {

/// A body with unknowns at one instant or level of a step, with derivatives by its unknowns.
struct BodyLevel {
  BodyInstant at;
  BodyVector acceleration = BodyVector::zero();  // [m/s2] of the centre of mass
  BodyVector spin_change = BodyVector::zero();   // [rad/s2] about the body's axes
  BodyVector increment = BodyVector::zero();     // [rad] in space: of the step, along the body's axes
  double between = 0;  // [-] of a level between the ends of the step: the shares of both, multiplied
  BodyNumber arc_acceleration[body_directions];  // [m/s2] of the unknowns

  /// The alpha level of a step.
  BodyLevel(const RigidBody& body, const StepView& view);
  /// A state as it stands, with other rates; its accelerations may be unknown.
  BodyLevel(const RigidBody& body, const State& state, const ConstNodalView& rate,
            const Sensitivity& by = {0, 0, 0, 0});

 private:
  void rates(const RigidBody& body, const ConstNodalView& rate, const ConstNodalView& acceleration,
             const Sensitivity& by);
  void place(const RigidBody& body);
};

/// Of a released body: what acts, along the model's axes.
BodyLoad load(const RigidBody& body, const BodyLevel& level);
/// A force along the model's axes as the body's unknown k feels it.
BodyNumber generalised(const RigidBody& body, const BodyLevel& level, const BodyLoad& load, int k);
/// Inertia along the unknown k: of the body and of the water that moves along.
class BodyInertiaForce {
 public:
  BodyInertiaForce(const RigidBody& body, const BodyLevel& level);
  BodyNumber operator[](int k) const { return force_[k]; }

 private:
  void in_space(const RigidBody& body, const BodyLevel& level);
  BodyNumber force_[body_directions];
};

/// [kg] in the plane.
double moving_mass(const RigidBody& body);

/// [N s], [N m s] about the centre of mass along the model's axes, [J]: of a body with unknowns and the water that
/// moves along.
struct BodyMomentum {
  Point linear{}, angular{};
  double kinetic = 0;
};
BodyMomentum momentum(const RigidBody& body, const State& state);

}  // namespace mudline
