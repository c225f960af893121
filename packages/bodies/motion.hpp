#pragma once

#include <array>
#include <memory>

#include "core/function.hpp"
#include "core/registry.hpp"

namespace mudline {

class ReleasedMotion;

/// Where a rigid body is and how it moves.
struct BodyState {
  std::array<double, 2> displacement{};  // [m] from the body's position at the start
  std::array<double, 2> velocity{};      // [m/s]
  double moving_time = 0;                // [s] since the body was last set in motion
};

/// Law of motion of a rigid body: type of a body's "motion".
class BodyMotion {
 public:
  virtual ~BodyMotion() = default;
  /// The state at t_end of a body that is in `old` at t_old; pure. Times are absolute [s].
  virtual BodyState advance(const BodyState& old, double t_old, double t_end) const = 0;
  /// False when the body can only move vertically.
  virtual bool lateral() const = 0;
  /// Itself where the body has degrees of freedom in the nonlinear system; null where its motion is prescribed.
  virtual const ReleasedMotion* released() const { return nullptr; }
};

/// Displacement follows the changes of two functions of time while the body is active: u += f(t_end) - f(t_old), so a
/// body that is set in motion in a later stage does not jump. Velocity: the mean of the step.
class PrescribedDisplacement : public BodyMotion {
 public:
  void parameters(Parameters& p);
  BodyState advance(const BodyState& old, double t_old, double t_end) const override;
  bool lateral() const override { return !x_.is_constant(); }

 private:
  Function x_, y_;
};

/// Velocity from two functions of time, multiplied over the ramp time by 3 s^2 - 2 s^3 (from rest, C1), s counted from
/// the moment the body is set in motion. Displacement by Gauss' rule with four points per step (on both sides of the
/// ramp's end), exact for polynomials of degree 7.
class PrescribedVelocity : public BodyMotion {
 public:
  void parameters(Parameters& p);
  BodyState advance(const BodyState& old, double t_old, double t_end) const override;
  bool lateral() const override { return !x_.is_zero(); }

 private:
  std::array<double, 2> velocity(double time, double moving_time) const;
  Function x_, y_;
  double ramp_time_ = 0;
};

/// The body stays where it is: what a stage names to hold a body that moves otherwise.
class Held : public BodyMotion {
 public:
  void parameters(Parameters&) {}
  BodyState advance(const BodyState& old, double t_old, double t_end) const override;
  bool lateral() const override { return false; }
};

void register_motions(Registry<BodyMotion>& registry);

}  // namespace mudline
