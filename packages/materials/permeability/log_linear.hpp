#pragma once

#include "materials/permeability.hpp"

namespace mudline {

/// log10 k linear in the void ratio: k = k0 10^((e - e0)/Ck) (Taylor 1948, Fundamentals of Soil Mechanics, ch. 6).
/// e0: "reference void ratio", else that of the point at the start.
class LogLinearPermeability : public PermeabilityOfForm {
 public:
  LogLinearPermeability() : PermeabilityOfForm(Conductivity::Form::log_linear) {}

 protected:
  void own_parameters(Parameters& p) override {
    p.required("hydraulic conductivity", law_.k0, "m/s", non_negative(), "Conductivity at the reference void ratio");
    p.required("permeability index", law_.ck, "-", positive(), "Ck, change of void ratio for a tenfold conductivity");
    p.add("reference void ratio", law_.e0, "-", non_negative(),
          "Void ratio to which the conductivity refers; 0: that of each point at the start");
  }
};

}  // namespace mudline
