#pragma once

#include "materials/permeability.hpp"

namespace mudline {

/// Kozeny-Carman: k = k0 c(e)/c(e0) with c(e) = e^3/(1+e) (Carman 1937; Lambe & Whitman 1969, ch. 19).
/// e0: "reference void ratio", else that of the point at the start. k is 0 where e is not positive.
class KozenyCarmanPermeability : public PermeabilityOfForm {
 public:
  KozenyCarmanPermeability() : PermeabilityOfForm(Conductivity::Form::kozeny_carman) {}

 protected:
  void own_parameters(Parameters& p) override {
    p.required("hydraulic conductivity", law_.k0, "m/s", non_negative(), "Conductivity at the reference void ratio");
    p.add("reference void ratio", law_.e0, "-", non_negative(),
          "Void ratio to which the conductivity refers; 0: that of each point at the start");
  }
};

}  // namespace mudline
