#include "contact/laws/normal_law.hpp"

namespace mudline {

void SmoothedNormalLaw::parameters(Parameters& p) {
  p.required("depth", law_.depth, "m", positive(), "penetration over which the stiffness grows to the penalty");
}

void register_normal_laws(Registry<NormalLaw>& registry) {
  registry.add<LinearNormalLaw>("linear", "Pressure that is the penalty times the penetration");
  registry.add<SmoothedNormalLaw>("smoothed",
                                  "The same behind a small depth over which it starts smoothly: fewer iterations");
}

}  // namespace mudline
