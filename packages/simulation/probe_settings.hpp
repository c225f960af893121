#pragma once

#include <string>

#include "core/function.hpp"

namespace mudline {

/// One entry of "output/probes".
struct ProbeSettings {
  std::string name;
  Point point{};           // [m] at the start
  bool at_node = true;     // the nearest node, wherever it goes
  std::string moves_with;  // else: a body; empty: a place in space
};

}  // namespace mudline
