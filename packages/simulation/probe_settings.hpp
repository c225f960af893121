#pragma once

#include <array>
#include <string>

namespace mudline {

/// One entry of "output/probes".
struct ProbeSettings {
  std::string name;
  std::array<double, 2> point{};  // [m] at the start
  bool at_node = true;            // the nearest node, wherever it goes
  std::string moves_with;         // else: a body; empty: a place in space
};

}  // namespace mudline
