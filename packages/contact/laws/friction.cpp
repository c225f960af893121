#include "contact/laws/friction.hpp"

#include <cmath>

namespace mudline {

void Friction::interface_parameters(Parameters& p) {
  p.add("tangential penalty factor", tangential_factor_, "-", positive(),
        "Stiffness along the surface while sticking, as a multiple of the normal penalty");
  p.choice(
      "on", traction_, {{"effective", Traction::effective}, {"total", Traction::total}},
      "Normal traction that friction grows with: effective (total less the soil's pore pressure at the surface) or "
      "total");
}

void declare_friction(Parameters& p) {
  p.passes_on("friction", "Friction along the surface; 'type' names a friction law; absent: none");
}

void CoulombFriction::parameters(Parameters& p) {
  p.required("coefficient", coefficient_, "-", non_negative(),
             "Friction coefficient: tangent of the interface's angle");
  p.add("kinetic coefficient", kinetic_, "-", non_negative(),
        "Friction coefficient at high speed, approached exponentially by 'decay speed'; absent: the coefficient at all "
        "speeds");
  p.add("decay speed", decay_speed_, "m/s", non_negative(),
        "Speed along the surface at which 1/e of the difference between coefficient and kinetic coefficient is left");
  p.add("adhesion", adhesion_, "Pa", non_negative(), "Shear strength of a touching surface without normal traction");
  p.add("full adhesion at", full_adhesion_at_, "Pa", non_negative(),
        "Normal traction from which on the adhesion acts in full, below in proportion; 0: as soon as the surface "
        "touches, so that the shear stress jumps where it opens");
  p.add("cap", cap_, "Pa",
        "Shear stress limit, a function of time and place, e.g. alpha times the undrained strength; absent: none");
  capped_ = p.given("cap");
  interface_parameters(p);
}

void CoulombFriction::check(const Section& section) const {
  const bool kinetic = section.has_parameter("kinetic coefficient"), speed = section.has_parameter("decay speed");
  if (kinetic && !(decay_speed_ > 0))
    section.fail("a kinetic coefficient needs a decay speed greater than 0 m/s", "decay speed");
  if (speed && !kinetic) section.fail("has a meaning only together with a 'kinetic coefficient'", "decay speed");
}

ShearStrength CoulombFriction::strength(const FrictionPoint& at) const {
  ShearStrength result{adhesion_, 0};
  double now = coefficient_, by_rate = 0;
  if (decay_speed_ > 0) {
    const double rest = (coefficient_ - kinetic_) * std::exp(-at.rate / decay_speed_);
    now = kinetic_ + rest;
    by_rate = -rest / decay_speed_;
  }
  const double normal = at.normal > 0 ? at.normal : 0.0;
  double stuck = adhesion_, by_normal = 0;
  if (normal < full_adhesion_at_) {
    by_normal = adhesion_ / full_adhesion_at_;
    stuck = by_normal * normal;
  }
  if (normal > 0)
    result = {stuck + now * normal, by_normal + now, by_rate * normal};
  else
    result.value = stuck;
  if (!capped_) return result;
  const double cap = cap_(at.time, at.position), limit = cap > 0 ? cap : 0.0;
  return result.value > limit ? ShearStrength{limit, 0} : result;
}

void register_friction(Registry<Friction>& registry) {
  registry.add<CoulombFriction>("coulomb", "Shear strength that grows with the normal traction, with adhesion and cap");
}

}  // namespace mudline
