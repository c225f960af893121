#pragma once

#include "framework/condition.hpp"
#include "framework/physics.hpp"

namespace mudline {

// Plain lists of what comes with mudline.

/// "biot", "solid", "thermo-hydro-mechanical".
void register_physics(Registry<Physics>& registry);
/// "heat".
void register_properties(Registry<Properties>& registry);
/// displacement, velocity, fixed, pore pressure, hydrostatic pressure, value, traction, pressure, flux, absorbing.
void register_conditions(Registry<Condition>& registry);

}  // namespace mudline
