#pragma once

#include "simulation/observer.hpp"
#include "simulation/results/result_table.hpp"

namespace mudline {

/// Follows the excess pore pressure of something through a stage, after each step: "<pressure> at the end" [Pa], and
/// how long after the stage's begin [s] a half and nine tenths of `highest` [Pa] were gone, linear between steps in the
/// logarithm of time. `highest` is the largest of the stage so far; one that has grown starts anew.
void follow_dissipation(const RunView& run, const std::string& of, const std::string& pressure, double now,
                        double highest, ResultTable& to);

/// Removes what follow_dissipation() has set.
void forget_dissipation(const RunView& run, const std::string& of, const std::string& pressure, ResultTable& from);

}  // namespace mudline
