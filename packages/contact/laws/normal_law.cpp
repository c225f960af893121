#include "contact/laws/normal_law.hpp"

namespace mudline {

void SmoothedNormalLaw::parameters(Parameters& p) {
  p.required("depth", depth_, "m", positive(), "penetration over which the stiffness grows to the penalty");
}

NormalPressure SmoothedNormalLaw::at(double penetration, double stiffness, const TouchingSoil&) const {
  if (penetration >= depth_) return {stiffness * (penetration - 0.5 * depth_), stiffness};
  return {0.5 * stiffness * penetration * penetration / depth_, stiffness * penetration / depth_};
}

void register_normal_laws(Registry<NormalLaw>& registry) {
  registry.add<LinearNormalLaw>("linear", "Pressure that is the penalty times the penetration");
  registry.add<SmoothedNormalLaw>("smoothed",
                                  "The same behind a small depth over which it starts smoothly: fewer iterations");
}

}  // namespace mudline
