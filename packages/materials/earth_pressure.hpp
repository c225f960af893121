#pragma once

#include <algorithm>
#include <cmath>

namespace mudline {

/// K0 = (1 - sin(phi)) R^sin(phi) of a soil with the overconsolidation ratio R (Jaky 1944; Mayne & Kulhawy 1982).
inline double earth_pressure_at_rest(double sine, double overconsolidation_ratio) {
  return (1.0 - sine) * std::pow(overconsolidation_ratio, sine);
}

/// The same, at most the passive ratio.
inline double earth_pressure_within_strength(double sine, double overconsolidation_ratio) {
  return std::min(earth_pressure_at_rest(sine, overconsolidation_ratio), (1.0 + sine) / (1.0 - sine));
}

}  // namespace mudline
