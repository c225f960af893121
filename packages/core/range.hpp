#pragma once

#include <string>

namespace mudline {

/// Allowed interval of a number; describes itself ("(0, 0.5)", "any").
struct Range {
  double low, high;
  bool low_open, high_open;
  bool contains(double value) const;
  std::string describe() const;
};
Range any();
Range positive();                          // (0, inf)
Range non_negative();                      // [0, inf)
Range closed(double low, double high);     // [low, high]
Range at_least(double low);                // [low, inf)
Range open(double low, double high);       // (low, high)
Range half_open(double low, double high);  // [low, high)

}  // namespace mudline
