#pragma once

#include "framework/term.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// Writes the surroundings of the points of elements [first, last), except their motion, for laws that ask for them;
/// columns as in Surroundings: positions at the end of the step, temperatures, element numbers and element lengths.
/// Rows of `to`: points, starting with those of element `first`.
void write_surroundings(const Soil& soil, const SoilBlock& block, const StepView& view, int first, int last,
                        const PointView& to);

}  // namespace mudline
