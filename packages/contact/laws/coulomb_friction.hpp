#pragma once

#include "contact/laws/friction.hpp"

namespace mudline {

/// strength = adhesion min(1, <normal> / full adhesion at) + coefficient <normal>, at most the cap and at most
/// alpha s_u R, with the present undrained strength s_u of the touching soil (the alpha method of pile design).
///     slip   the coefficient falls from the peak to the residual one by exp(-slip / residual slip)
///     speed  with a kinetic coefficient: kinetic + (coefficient - kinetic) exp(-rate / decay speed)
///     rate   R = 1 + rate coefficient log10(rate / reference speed), at least 1
/// Where the touching soil has no s_u and a drained coefficient is given: strength = drained coefficient <normal>, at
/// most the cap, with the effective traction for `normal`.
class CoulombFriction : public Friction {
 public:
  void parameters(Parameters& p);
  void check(const Section& section) const;
  ShearStrength strength(const FrictionPoint& at) const override;
  SoilQuantities reads() const override;
  bool effective_on(const TouchingSoil& soil) const override { return effective() || drained_on(soil); }
  bool reads_slip() const override { return residual_slip_ > 0; }

 private:
  /// alpha times the touching soil's undrained strength, at the speed.
  ShearStrength limit_of_soil(const FrictionPoint& at) const;
  /// Coefficient times the normal traction, and the adhesion.
  ShearStrength by_coefficient(const FrictionPoint& at) const;
  /// Whether the drained coefficient holds on this soil.
  bool drained_on(const TouchingSoil& soil) const;

  double coefficient_ = 0, kinetic_ = 0, residual_ = 0;
  double decay_speed_ = 0;    // [m/s] 0: one coefficient at all speeds
  double residual_slip_ = 0;  // [m] 0: no residual coefficient
  Function adhesion_;
  double full_adhesion_at_ = 0;  // [Pa] normal traction; 0: the adhesion is there as soon as the surface touches
  bool capped_ = false, by_soil_ = false, drains_ = false;
  double drained_coefficient_ = 0;  // [-] of soil without an undrained strength
  Function cap_, alpha_;
  double rate_coefficient_ = 0, reference_speed_ = 0;  // [-], [m/s]
};

}  // namespace mudline
