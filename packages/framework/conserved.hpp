#pragma once

#include <functional>
#include <string>

#include "framework/state.hpp"

namespace mudline {

/// The conserved quantity (heat, a solute) of the balance of a scalar field, for the audits of the history file.
struct Conserved {
  std::string name, unit;  // "heat", "J"
  int field;
  std::function<double(const State&)> content;  // content of the whole mesh; collective
  int carrier = -1;                             // field whose flow transports it; -1: none
  double carried = 0, reference = 0;            // transported per outflow of that field: carried * (value - reference)
};

}  // namespace mudline
