#pragma once

#include <string>
#include <vector>

#include "simulation/results/result_table.hpp"

namespace mudline {

/// The results as a run tells them at its end: a line for each stage and for each thing in it, then those of the whole
/// run. Where there are more than `most` lines, the first ones are left out, and a line says so.
std::vector<std::string> result_lines(const ResultTable& results, std::size_t most);

}  // namespace mudline
