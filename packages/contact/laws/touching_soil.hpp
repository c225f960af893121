#pragma once

#include <limits>

namespace mudline {

/// State of the touching soil at a contact point.
struct TouchingSoil {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();  // a quantity that no law reads
  double pore_pressure = 0;      // [Pa] compression positive, at the end of the step; 0 in soil without pore pressure
  double temperature = unknown;  // [degC] at the start of the step
  double mean_stress = unknown;  // [Pa] effective, compression positive: mean over the element behind, at the start
  double undrained_strength = unknown;  // [Pa] of the element behind, at the contact point, at the start of the step
};

/// Quantities of TouchingSoil that a law reads. A contact that does not know one of them refuses the law.
struct SoilQuantities {
  bool pore_pressure = false, temperature = false, mean_stress = false, undrained_strength = false;
  bool strength_if_any = false;  // takes soil without an undrained strength, too, where that is not a number
};

}  // namespace mudline
