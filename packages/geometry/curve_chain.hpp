#pragma once

#include <vector>

#include "core/section.hpp"
#include "discretisation/cad_curve.hpp"

namespace mudline {

/// The curves in the order and direction in which each starts where the one before ends; a chain that is closed starts
/// with the first curve as it is given. Ends that are within `tolerance` of each other meet. InputError at `entry` for
/// curves that branch, or make more than one chain.
std::vector<CadCurve> chained(const std::vector<CadCurve>& curves, double tolerance, const Section& section,
                              const std::string& entry);

/// The chain traversed from its other end.
std::vector<CadCurve> backwards(const std::vector<CadCurve>& chain);

}  // namespace mudline
