#include "contact/laws/normal_law.hpp"

#include <algorithm>
#include <limits>

namespace mudline {

void SmoothedNormalLaw::parameters(Parameters& p) {
  p.required("depth", depth_, "m", positive(), "penetration over which the stiffness grows to the penalty");
}

double penetration_under(const NormalLaw& law, double pressure, double stiffness, const TouchingSoil& soil) {
  if (law.linear() || !(pressure > 0)) return std::max(0.0, pressure) / stiffness;
  constexpr int most_doublings = 60, halvings = 100;
  double low = 0, high = pressure / stiffness;
  for (int i = 0; law.at(high, stiffness, soil).value < pressure; ++i, high *= 2)
    if (i == most_doublings) return std::numeric_limits<double>::infinity();
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (law.at(middle, stiffness, soil).value < pressure ? low : high) = middle;
  }
  return high;
}

void register_normal_laws(Registry<NormalLaw>& registry) {
  registry.add<LinearNormalLaw>("linear", "Pressure that is the penalty times the penetration");
  registry.add<SmoothedNormalLaw>("smoothed",
                                  "The same behind a small depth over which it starts smoothly: fewer iterations");
}

}  // namespace mudline
