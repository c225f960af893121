#pragma once

#include <limits>

namespace mudline {

/// The soil that touches, at a contact point.
struct TouchingSoil {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();  // what no law asked for
  double pore_pressure = 0;      // [Pa] compression positive, at the end of the step; 0 in soil without
  double temperature = unknown;  // [degC] at the start of the step
  double mean_stress = unknown;  // [Pa] effective, compression positive: mean over the element behind, at the start
};

/// What of it a law reads. A contact refuses the law where it cannot tell.
struct SoilQuantities {
  bool pore_pressure = false, temperature = false, mean_stress = false;
};

}  // namespace mudline
