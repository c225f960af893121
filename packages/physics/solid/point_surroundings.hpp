#pragma once

#include "framework/term.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// Writes what laws that ask for it are told of the points of elements [first, last) beside their motion, columns as in
/// Surroundings: places of the step's end, temperatures, numbers and lengths of elements. Rows of `to`: points, from
/// that of element `first`.
void write_surroundings(const Soil& soil, const SoilBlock& block, const StepView& view, int first, int last,
                        const PointView& to);

}  // namespace mudline
