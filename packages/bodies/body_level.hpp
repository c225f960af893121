#pragma once

#include "bodies/rigid_body.hpp"

namespace mudline {

/// A body with unknowns at one instant or level of a step, with derivatives by its unknowns.
struct BodyLevel {
  BodyInstant at;
  BodyVector acceleration = BodyVector::zero();  // [m/s2] of the centre of mass
  BodyVector spin_change = BodyVector::zero();   // [rad/s2] about the body's axes
  BodyVector increment = BodyVector::zero();     // [rad] in space: rotation over the step, along the body's axes
  double between = 0;  // [-] product of the shares that the old and the new state have in the level
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

/// Load on a released body, in the world frame.
BodyLoad load(const RigidBody& body, const BodyLevel& level);
/// Generalised force of a load along the body's unknown k [N].
BodyNumber generalised(const RigidBody& body, const BodyLevel& level, const BodyLoad& load, int k);
/// Generalised inertia force along the unknown k [N]: of the body and of the water that moves with it.
class BodyInertiaForce {
 public:
  BodyInertiaForce(const RigidBody& body, const BodyLevel& level);
  BodyNumber operator[](int k) const { return force_[k]; }

 private:
  void in_space(const RigidBody& body, const BodyLevel& level);
  BodyNumber force_[body_directions];
};

/// Mass of the body and of the water that moves with it, in the plane [kg].
double moving_mass(const RigidBody& body);

/// Momentum [N s], angular momentum about the centre of mass [N m s] and kinetic energy [J], in the world frame, of a
/// body with unknowns and the water that moves with it.
struct BodyMomentum {
  Point linear{}, angular{};
  double kinetic = 0;
};
BodyMomentum momentum(const RigidBody& body, const State& state);

}  // namespace mudline
