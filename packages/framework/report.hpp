#pragma once

#include <map>
#include <string>

namespace mudline {

/// One scalar of the history file.
struct Quantity {
  std::string unit;
  double value = 0;
  bool lasting = false;  // a sum over time: it keeps its value while its source does not act
};

/// Quantities by name, groups separated by "/": "body/cone/spin".
using Report = std::map<std::string, Quantity>;

}  // namespace mudline
