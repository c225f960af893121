#pragma once

#include <cmath>

#include "materials/permeability.hpp"

namespace mudline {

/// log10 k linear in the void ratio: k = k0 10^((e - e0)/Ck) (Taylor 1948, Fundamentals of Soil Mechanics, ch. 6).
/// e0: "reference void ratio", else that of the point at the start.
class LogLinearPermeability : public Permeability {
 public:
  void parameters(Parameters& p) {
    p.required("hydraulic conductivity", conductivity_, "m/s", non_negative(),
               "Conductivity at the reference void ratio");
    p.required("permeability index", index_, "-", positive(), "Ck, change of void ratio for a tenfold conductivity");
    p.add("reference void ratio", reference_, "-", non_negative(),
          "Void ratio to which the conductivity refers; 0: that of each point at the start");
  }
  Value conductivity(double e, double initial_void_ratio) const override {
    const double e0 = reference_ > 0.0 ? reference_ : initial_void_ratio;
    const double rate = std::log(10.0) / index_, k = conductivity_ * std::exp(rate * (e - e0));
    return {k, k * rate};
  }

 private:
  double conductivity_ = 1e-9;  // [m/s]
  double index_ = 0.5;          // [-]
  double reference_ = 0.0;      // [-]
};

}  // namespace mudline
