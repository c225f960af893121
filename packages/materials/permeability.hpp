#pragma once

#include "core/parameters.hpp"

namespace mudline {

/// Hydraulic conductivity k [m/s] of the soil as a function of its void ratio e.
class Permeability {
 public:
  virtual ~Permeability() = default;
  struct Value {
    double k;      // [m/s]
    double dk_de;  // [m/s]
  };
  /// `initial_void_ratio`: that of the point at the start, to which reference values refer unless the deck gives one.
  virtual Value conductivity(double void_ratio, double initial_void_ratio) const = 0;
};

}  // namespace mudline
