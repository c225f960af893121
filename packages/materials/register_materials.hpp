#pragma once

#include "core/registry.hpp"
#include "materials/fluid.hpp"
#include "materials/permeability.hpp"
#include "materials/skeleton.hpp"

namespace mudline {

/// Registers the built-in laws.
void register_materials(Registry<Skeleton>& skeletons, Registry<Fluid>& fluids, Registry<Permeability>& permeabilities);

}  // namespace mudline
