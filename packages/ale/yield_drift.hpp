#pragma once

#include "physics/soil.hpp"

namespace mudline {

/// How far a remap moved stresses out of the yield surface [-]: root mean square over all points of the laws'
/// correction (evaluated less remapped effective stress), over that of the stress itself. 0: no stress was corrected.
/// Collective.
double yield_drift(const Soil& soil, const State& remapped, const State& evaluated);

}  // namespace mudline
