#include "contact/laws/friction.hpp"

#include <math.h>  // unqualified functions, as in tensor/dual.hpp

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
  p.required("coefficient", law_.coefficient, "-", non_negative(),
             "Friction coefficient: tangent of the interface's angle");
  p.add("kinetic coefficient", law_.kinetic, "-", non_negative(),
        "Friction coefficient at high speed, approached exponentially by 'decay speed'; absent: the coefficient at all "
        "speeds");
  p.add("decay speed", law_.decay_speed, "m/s", non_negative(),
        "Speed along the surface at which 1/e of the difference between coefficient and kinetic coefficient is left");
  p.add("adhesion", law_.adhesion, "Pa", non_negative(),
        "Shear strength of a touching surface without normal traction");
  p.add("full adhesion at", law_.full_adhesion_at, "Pa", non_negative(),
        "Normal traction from which on the adhesion acts in full, below in proportion; 0: as soon as the surface "
        "touches, so that the shear stress jumps where it opens");
  p.add("cap", cap_, "Pa",
        "Shear stress limit, a function of time and place, e.g. alpha times the undrained strength; absent: none");
  law_.capped = p.given("cap");
  interface_parameters(p);
}

void CoulombFriction::check(const Section& section) const {
  const bool kinetic = section.has_parameter("kinetic coefficient"), speed = section.has_parameter("decay speed");
  if (kinetic && !(law_.decay_speed > 0))
    section.fail("a kinetic coefficient needs a decay speed greater than 0 m/s", "decay speed");
  if (speed && !kinetic) section.fail("has a meaning only together with a 'kinetic coefficient'", "decay speed");
}

KOKKOS_FUNCTION ShearStrength CoulombStrength::operator()(const FrictionPoint& at) const {
  ShearStrength result{adhesion, 0};
  double now = coefficient, by_rate = 0;
  if (decay_speed > 0) {
    const double rest = (coefficient - kinetic) * ::exp(-at.rate / decay_speed);
    now = kinetic + rest;
    by_rate = -rest / decay_speed;
  }
  const double normal = at.normal > 0 ? at.normal : 0.0;
  double stuck = adhesion, by_normal = 0;
  if (normal < full_adhesion_at) {
    by_normal = adhesion / full_adhesion_at;
    stuck = by_normal * normal;
  }
  if (normal > 0)
    result = {stuck + now * normal, by_normal + now, by_rate * normal};
  else
    result.value = stuck;
  if (!capped) return result;
  const double limit = cap > 0 ? cap : 0.0;
  return result.value > limit ? ShearStrength{limit, 0} : result;
}

ShearStrength CoulombFriction::strength(const FrictionPoint& at) const {
  CoulombStrength law = law_;
  if (law.capped) law.cap = cap_(at.time, at.position);
  return law(at);
}

void CoulombFriction::strengths(const LawList<FrictionPoint, ShearStrength>& list) const {
  if (law_.capped && !cap_.is_constant()) return Friction::strengths(list);
  CoulombStrength law = law_;
  if (law.capped) law.cap = cap_(0, {});
  ask_in_kernel(law, list);
}

void register_friction(Registry<Friction>& registry) {
  registry.add<CoulombFriction>("coulomb", "Shear strength that grows with the normal traction, with adhesion and cap");
}

}  // namespace mudline
