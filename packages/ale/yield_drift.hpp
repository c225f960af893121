#pragma once

#include "physics/soil.hpp"

namespace mudline {

/// How far a remap carried stresses out of the yield surface [-]: root mean square over all points of what the laws
/// took back (evaluated less remapped effective stress) over that of the stress itself. 0: no stress was touched.
/// Collective.
double yield_drift(const Soil& soil, const State& remapped, const State& evaluated);

}  // namespace mudline
