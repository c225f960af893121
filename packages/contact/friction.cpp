#include "contact/friction.hpp"

#include <algorithm>

namespace mudline {

void Friction::interface_parameters(Parameters& p) {
  p.add("tangential penalty factor", tangential_factor_, "-", positive(),
        "Stiffness along the surface while sticking, as a multiple of the normal penalty");
  p.choice(
      "on", traction_, {{"effective", Traction::effective}, {"total", Traction::total}},
      "Normal traction that friction grows with: effective (total less the soil's pore pressure at the surface) or "
      "total");
}

void CoulombFriction::parameters(Parameters& p) {
  p.required("coefficient", coefficient_, "-", non_negative(),
             "Friction coefficient: tangent of the interface's angle");
  p.add("adhesion", adhesion_, "Pa", non_negative(), "Shear strength of a touching surface without normal traction");
  p.add("cap", cap_, "Pa",
        "Shear stress limit, a function of time and place, e.g. alpha times the undrained strength; absent: none");
  capped_ = p.given("cap");
  interface_parameters(p);
}

ShearStrength CoulombFriction::strength(const FrictionPoint& at) const {
  ShearStrength result{adhesion_, 0};
  if (at.normal > 0) result = {adhesion_ + coefficient_ * at.normal, coefficient_};
  if (!capped_) return result;
  const double cap = std::max(0.0, cap_(at.time, {at.position[0], at.position[1], 0}));
  return result.value > cap ? ShearStrength{cap, 0} : result;
}

void register_friction(Registry<Friction>& registry) {
  registry.add<CoulombFriction>("coulomb", "Shear strength that grows with the normal traction, with adhesion and cap");
}

}  // namespace mudline
