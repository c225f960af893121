#include "materials/skeleton/von_mises.hpp"

namespace mudline {

void VonMises::parameters(Parameters& p) {
  elasticity.parameters(p);
  p.required("yield stress", yield_stress, "Pa", positive(), "Deviatoric stress q at first yield");
  p.add("hardening modulus", hardening, "Pa", non_negative(),
        "Linear growth of the yield stress with equivalent plastic strain");
  p.add("saturation stress", saturation, "Pa", non_negative(), "Growth of the yield stress that Voce's law tends to");
  p.add("saturation rate", saturation_rate, "-", non_negative(),
        "How fast Voce's law saturates, per unit of plastic strain");
  integration.parameters(p, "the initial yield stress");
}

void VonMises::check(const Section& section) const {
  integration.check(section);
  if (section.has_parameter("saturation stress") != section.has_parameter("saturation rate"))
    section.fail("'saturation stress' and 'saturation rate' belong together");
}

std::vector<StateVariable> VonMises::state() {
  return {{"equivalent plastic strain", 1, "-", Transfer::value, 0.0, 1e300}};
}

template class PointwiseSkeleton<AutomaticTangent<VonMises>>;

}  // namespace mudline
