#pragma once

#include "materials/permeability.hpp"

namespace mudline {

/// k independent of the void ratio.
class ConstantPermeability : public PermeabilityOfForm {
 public:
  ConstantPermeability() : PermeabilityOfForm(Conductivity::Form::constant) {}

 protected:
  void own_parameters(Parameters& p) override {
    p.required("hydraulic conductivity", law_.k0, "m/s", non_negative(),
               "Conductivity to the pore fluid at every void ratio");
  }
};

}  // namespace mudline
