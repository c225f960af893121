#pragma once

#include <functional>
#include <string>

#include "physics/soil.hpp"

namespace mudline {

/// Finds the overconsolidation ratio, 1 or more, with which the law of a material starts a point with an undrained
/// strength [Pa], and sets it. `rest` sets the stress of a point for its overconsolidation ratio, and returns "" or the
/// problem. A point whose law has no undrained strength is normally consolidated. Returns "" or the reason why there is
/// no such ratio.
std::string overconsolidate(const SoilMaterial& material, double strength,
                            const std::function<std::string(InitialPoint&)>& rest, InitialPoint& point);

}  // namespace mudline
