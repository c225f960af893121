#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/skeleton.hpp"

namespace mudline {

/// K0 = (1 - sin(phi)) R^sin(phi) of a soil with the overconsolidation ratio R (Jaky 1944; Mayne & Kulhawy 1982).
inline double earth_pressure_at_rest(double sine, double overconsolidation_ratio) {
  return (1.0 - sine) * std::pow(overconsolidation_ratio, sine);
}

/// K0 as above, but at most the passive ratio.
inline double earth_pressure_within_strength(double sine, double overconsolidation_ratio) {
  return std::min(earth_pressure_at_rest(sine, overconsolidation_ratio), (1.0 + sine) / (1.0 - sine));
}

/// Limits that a circular cone sqrt(J2) = k + eta p' sets for the horizontal stress at a vertical stress [Pa].
inline EarthPressures cone_earth_pressures(double vertical, double slope, double intercept) {
  const double root3 = std::sqrt(3.0), a = 1 / root3, b = slope / 3, room = a - 2 * b;
  const double passive = room > 0 ? (vertical * (a + b) + intercept) / room : std::numeric_limits<double>::infinity();
  return {(vertical * (a - b) - intercept) / (a + 2 * b), passive};
}

/// Rankine's earth pressures with cohesion.
inline EarthPressures rankine_earth_pressures(double vertical, double sine, double cohesion) {
  const double active = (1 - sine) / (1 + sine), root = std::sqrt(active);
  return {vertical * active - 2 * cohesion * root, vertical / active + 2 * cohesion / root};
}

}  // namespace mudline
