#pragma once

#include "framework/term.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// Writes what laws that ask for it are told of the points of elements [first, last) beside their strain, columns as in
/// Surroundings. The places are those of the step's end, and the deformation is that from its start. Rows of `to`:
/// points, from that of element `first`.
void write_surroundings(const Soil& soil, const SoilBlock& block, const StepView& view, int first, int last,
                        const PointView& to);

}  // namespace mudline
