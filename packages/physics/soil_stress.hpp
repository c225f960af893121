#pragma once

#include <array>

#include "physics/soil.hpp"

namespace mudline {

/// Total stress sigma' - alpha p [Pa, tension positive, components as in sym6] of an element, extrapolated to a
/// position near it [m] by a linear least squares fit to the element's points, or by their mean where they do not span
/// the space (one point).
std::array<double, 6> total_stress(const Soil& soil, const State& state, int block, int element, const Point& at);

/// Present undrained strength [Pa] of an element's soil, fitted alike and not below zero; not a number where the soil's
/// law has none.
double undrained_strength(const Soil& soil, const State& state, int block, int element, const Point& at);

}  // namespace mudline
