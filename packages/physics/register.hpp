#pragma once

#include "framework/condition.hpp"
#include "framework/physics.hpp"

namespace mudline {

// Plain lists of the built-in types.

/// Registers "biot", "solid" and "thermo-hydro-mechanical".
void register_physics(Registry<Physics>& registry);
/// Registers "heat".
void register_properties(Registry<Properties>& registry);
/// Registers the conditions that the program itself has, displacement to absorbing.
void register_conditions(Registry<Condition>& registry);

}  // namespace mudline
