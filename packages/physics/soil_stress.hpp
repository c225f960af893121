#pragma once

#include <array>

#include "physics/soil.hpp"

namespace mudline {

/// Total stress sigma' - alpha p [Pa, tension positive, as sym6 numbers it] of a state in an element of a block,
/// carried on to a place near it [m]: linear through the element's points by least squares, and where they do not span
/// the space (one point) their mean.
std::array<double, 6> total_stress(const Soil& soil, const State& state, int block, int element, const Point& at);

}  // namespace mudline
