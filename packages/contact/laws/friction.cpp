#include "contact/laws/friction.hpp"

#include "contact/laws/coulomb_friction.hpp"

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

void register_friction(Registry<Friction>& registry) {
  registry.add<CoulombFriction>("coulomb", "Shear strength that grows with the normal traction, with adhesion and cap");
}

}  // namespace mudline
