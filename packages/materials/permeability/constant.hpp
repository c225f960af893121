#pragma once

#include "materials/permeability.hpp"

namespace mudline {

/// k independent of the void ratio.
class ConstantPermeability : public Permeability {
 public:
  void parameters(Parameters& p) {
    p.required("hydraulic conductivity", conductivity_, "m/s", non_negative(),
               "Conductivity to the pore fluid at every void ratio");
  }
  Value conductivity(double, double) const override { return {conductivity_, 0.0}; }

 private:
  double conductivity_ = 1e-9;  // [m/s]
};

}  // namespace mudline
