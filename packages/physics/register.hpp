#pragma once

#include "framework/condition.hpp"
#include "framework/physics.hpp"

namespace mudline {

// Plain lists of the built-in types.

/// Registers "biot", "solid" and "thermo-hydro-mechanical".
void register_physics(Registry<Physics>& registry);
/// Registers "heat".
void register_properties(Registry<Properties>& registry);
/// Registers displacement, velocity, fixed, pore pressure, hydrostatic pressure, value, traction, pressure, flux and
/// absorbing.
void register_conditions(Registry<Condition>& registry);

}  // namespace mudline
