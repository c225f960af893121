#pragma once

#include <memory>

#include "core/function.hpp"
#include "core/registry.hpp"
#include "tensor/rotation.hpp"

namespace mudline {

class ReleasedMotion;

/// Where a rigid body is and how it moves. In the plane the third components are 0.
struct BodyState {
  Point displacement{};    // [m] of the centre of mass from where it was at the start
  Point velocity{};        // [m/s]
  Rotation turn;           // about the centre of mass, from the orientation of the body's frame
  Point spin{};            // [rad/s]
  double moving_time = 0;  // [s] since the body was last set in motion
};

/// Law of motion of a rigid body: type of a body's "motion".
class BodyMotion {
 public:
  virtual ~BodyMotion() = default;
  /// The state at t_end of a body that is in `old` at t_old; pure. Times are absolute [s].
  virtual BodyState advance(const BodyState& old, double t_old, double t_end) const = 0;
  /// Whether it moves along an axis (0, 1, 2: x, y, z), or turns about any.
  virtual bool moves(int axis) const = 0;
  virtual bool turns() const = 0;
  /// Itself where the body has degrees of freedom in the nonlinear system; null where its motion is prescribed.
  virtual const ReleasedMotion* released() const { return nullptr; }
};

/// What is prescribed of a body as functions of time: along the axes, and in space about them.
class PrescribedMotion : public BodyMotion {
 public:
  bool moves(int axis) const override { return !along_[axis].is_constant(); }
  bool turns() const override;

 protected:
  Function along_[3], about_[3];
};

/// Displacement follows the changes of functions of time while the body is active: u += f(t_end) - f(t_old), so a body
/// that is set in motion in a later stage does not jump. The same of the rotation vector: R(f(t_end)) R(f(t_old))^-1
/// comes on top. Velocity and spin: the means of the step.
class PrescribedDisplacement : public PrescribedMotion {
 public:
  void parameters(Parameters& p);
  BodyState advance(const BodyState& old, double t_old, double t_end) const override;

 private:
  void turning_parameters(Parameters& p);
  /// InputError for a displacement that would not move the body.
  void refuse_rest(Parameters& p) const;
};

/// Velocity and spin from functions of time, multiplied over the ramp time by 3 s^2 - 2 s^3 (from rest, C1), s counted
/// from the moment the body is set in motion. Displacement by Gauss' rule with four points per step (on both sides of
/// the ramp's end), exact for polynomials of degree 7; rotation by the same mean of the spin, exact about a fixed axis.
class PrescribedVelocity : public PrescribedMotion {
 public:
  void parameters(Parameters& p);
  BodyState advance(const BodyState& old, double t_old, double t_end) const override;
  bool moves(int axis) const override { return !along_[axis].is_zero(); }

 private:
  double ramp(double moving_time) const;
  double ramp_time_ = 0;
};

/// The body stays where it is: what a stage names to hold a body that moves otherwise.
class Held : public BodyMotion {
 public:
  void parameters(Parameters&) {}
  BodyState advance(const BodyState& old, double t_old, double t_end) const override;
  bool moves(int) const override { return false; }
  bool turns() const override { return false; }
};

void register_motions(Registry<BodyMotion>& registry);

}  // namespace mudline
