#pragma once

#include <functional>
#include <string>

#include "framework/state.hpp"

namespace mudline {

/// What the balance of a scalar field conserves, for the audits of the history file: heat, a solute.
struct Conserved {
  std::string name, unit;  // "heat", "J"
  int field;
  std::function<double(const State&)> content;  // of the whole mesh; collective
  int transfer = -1;                            // field whose flow carries it; -1: none
  double transferred = 0, reference = 0;        // per outflow of the carrier: carried * (value - reference)
};

}  // namespace mudline
