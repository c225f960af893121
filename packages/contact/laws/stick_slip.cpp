#include "contact/laws/stick_slip.hpp"

#include <cmath>

namespace mudline {

ShearResponse stick_or_slide(const Friction& law, const ShearState& old, double stiffness, double travel, double dt,
                             const FrictionPoint& at) {
  const double trial = old.shear - stiffness * travel;
  const ShearStrength strength = law.strength(at);
  ShearResponse result{old, -stiffness, 0};
  result.now.shear = trial;
  result.now.slides = std::abs(trial) > strength.value;
  if (!result.now.slides) return result;
  const double direction = trial > 0 ? 1 : -1;
  result.now.shear = direction * strength.value;
  result.now.slip += (std::abs(trial) - strength.value) / stiffness;
  result.elastic = direction * strength.rate_slope * (travel > 0 ? 1 : -1) / dt;
  result.normal = direction * strength.slope;
  return result;
}

TouchingTravel::TouchingTravel(double gap_old, double gap, double travel) : value(travel), fraction(1), gap_slope(0) {
  if (gap_old <= 0) return;
  if (gap >= 0) {  // held in tension by a fixed active set: it has not touched yet
    value = fraction = 0;
    return;
  }
  const double closing = gap - gap_old;
  fraction = gap / closing;
  gap_slope = -travel * gap_old / (closing * closing);
  value *= fraction;
}

}  // namespace mudline
