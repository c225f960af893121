#include "contact/laws/coulomb_friction.hpp"

#include <algorithm>
#include <cmath>

namespace mudline {

namespace {

ShearStrength lesser(const ShearStrength& one, const ShearStrength& other) {
  return one.value > other.value ? other : one;
}

}  // namespace

void CoulombFriction::parameters(Parameters& p) {
  p.required("coefficient", coefficient_, "-", non_negative(),
             "Friction coefficient: tangent of the interface's angle");
  p.add("residual coefficient", residual_, "-", non_negative(),
        "Friction coefficient after much slip, approached exponentially by 'residual slip'; absent: the coefficient");
  p.add("residual slip", residual_slip_, "m", non_negative(),
        "Path slid after which 1/e of the difference between coefficient and residual coefficient is left");
  p.add("kinetic coefficient", kinetic_, "-", non_negative(),
        "Friction coefficient at high speed, approached exponentially by 'decay speed'; absent: the coefficient at all "
        "speeds");
  p.add("decay speed", decay_speed_, "m/s", non_negative(),
        "Speed along the surface at which 1/e of the difference between coefficient and kinetic coefficient is left");
  p.add("adhesion", adhesion_, "Pa",
        "Shear strength of a touching surface without normal traction, a function of time and place");
  p.add("full adhesion at", full_adhesion_at_, "Pa", non_negative(),
        "Normal traction from which on the adhesion acts in full, below in proportion; 0: as soon as the surface "
        "touches, so that the shear stress jumps where it opens");
  p.add("cap", cap_, "Pa", "Shear stress limit, a function of time and place; absent: none");
  p.add("alpha", alpha_, "-",
        "Shear stress limit over the present undrained strength of the touching soil, a function of time and place; "
        "absent: none");
  p.add("rate coefficient", rate_coefficient_, "-", non_negative(),
        "Gain of the limit by 'alpha' for a tenfold speed along the surface");
  p.add("reference speed", reference_speed_, "m/s", non_negative(),
        "Speed along the surface up to which the limit by 'alpha' does not grow");
  p.add("drained coefficient", drained_coefficient_, "-", non_negative(),
        "With 'alpha': friction coefficient on the effective traction where the touching soil has no undrained "
        "strength, as sand; absent: such soil is refused");
  capped_ = p.given("cap");
  by_soil_ = p.given("alpha");
  drains_ = p.given("drained coefficient");
  interface_parameters(p);
}

void CoulombFriction::check(const Section& section) const {
  // Refuses one of two entries that have a meaning only together.
  const auto pair = [&](const std::string& value, const std::string& scale, double given, const char* unit) {
    if (section.has_parameter(value) && !(given > 0))
      section.fail("a " + value + " needs a " + scale + " greater than 0 " + unit, scale);
    if (section.has_parameter(scale) && !section.has_parameter(value))
      section.fail("has a meaning only together with a '" + value + "'", scale);
  };
  pair("kinetic coefficient", "decay speed", decay_speed_, "m/s");
  pair("residual coefficient", "residual slip", residual_slip_, "m");
  pair("rate coefficient", "reference speed", reference_speed_, "m/s");
  if (section.has_parameter("rate coefficient") && !by_soil_)
    section.fail("has a meaning only together with 'alpha'", "rate coefficient");
  if (drains_ && !by_soil_) section.fail("has a meaning only together with 'alpha'", "drained coefficient");
  if (section.has_parameter("full adhesion at") && !section.has_parameter("adhesion"))
    section.fail("has a meaning only together with an 'adhesion'", "full adhesion at");
  const auto not_negative = [&](const char* entry, const Function& value) {
    if (value.is_constant() && value(0, {}) < 0) section.fail("must not be negative", entry);
  };
  not_negative("adhesion", adhesion_);
  not_negative("cap", cap_);
  not_negative("alpha", alpha_);
}

SoilQuantities CoulombFriction::reads() const {
  SoilQuantities result;
  result.undrained_strength = by_soil_;
  result.strength_if_any = drains_;
  result.pore_pressure = drains_ && !effective();  // the effective traction is then needed on drained soil alone
  return result;
}

ShearStrength CoulombFriction::strength(const FrictionPoint& at) const {
  const bool drained = drained_on(at.soil);
  ShearStrength result{0, 0};
  if (!drained) result = by_coefficient(at);
  if (drained && at.normal > 0) result = {drained_coefficient_ * at.normal, drained_coefficient_};
  if (capped_) result = lesser(result, {std::max(0.0, cap_(at.time, at.position)), 0});
  return by_soil_ && !drained ? lesser(result, limit_of_soil(at)) : result;
}

ShearStrength CoulombFriction::by_coefficient(const FrictionPoint& at) const {
  double now = coefficient_, by_rate = 0;
  if (residual_slip_ > 0) now = residual_ + (now - residual_) * std::exp(-at.slip / residual_slip_);
  if (decay_speed_ > 0) {
    const double rest = (now - kinetic_) * std::exp(-at.rate / decay_speed_);
    now = kinetic_ + rest;
    by_rate = -rest / decay_speed_;
  }
  const double adhesion = std::max(0.0, adhesion_(at.time, at.position)), normal = at.normal > 0 ? at.normal : 0.0;
  double stuck = adhesion, by_normal = 0;
  if (normal < full_adhesion_at_) {
    by_normal = adhesion / full_adhesion_at_;
    stuck = by_normal * normal;
  }
  if (!(normal > 0)) return {stuck, 0};
  return {stuck + now * normal, by_normal + now, by_rate * normal};
}

bool CoulombFriction::drained_on(const TouchingSoil& soil) const {
  return drains_ && std::isnan(soil.undrained_strength);
}

ShearStrength CoulombFriction::limit_of_soil(const FrictionPoint& at) const {
  const double at_rest = std::max(0.0, alpha_(at.time, at.position) * at.soil.undrained_strength);
  if (!(rate_coefficient_ > 0) || !(at.rate > reference_speed_)) return {at_rest, 0};
  const double per_decade = at_rest * rate_coefficient_;
  return {at_rest + per_decade * std::log10(at.rate / reference_speed_), 0, per_decade / (at.rate * std::log(10.0))};
}

}  // namespace mudline
