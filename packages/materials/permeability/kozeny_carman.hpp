#pragma once

#include "materials/permeability.hpp"

namespace mudline {

/// Kozeny-Carman: k = k0 c(e)/c(e0) with c(e) = e^3/(1+e) (Carman 1937; Lambe & Whitman 1969, ch. 19).
/// e0: "reference void ratio", else that of the point at the start. k is 0 where e is not positive.
class KozenyCarmanPermeability : public Permeability {
 public:
  void parameters(Parameters& p) {
    p.required("hydraulic conductivity", conductivity_, "m/s", non_negative(),
               "Conductivity at the reference void ratio");
    p.add("reference void ratio", reference_, "-", non_negative(),
          "Void ratio to which the conductivity refers; 0: that of each point at the start");
  }
  Value conductivity(double e, double initial_void_ratio) const override {
    if (!(e > 0.0)) return {0.0, 0.0};
    const double e0 = reference_ > 0.0 ? reference_ : initial_void_ratio;
    const double factor = conductivity_ * (1.0 + e0) / (e0 * e0 * e0);
    return {factor * e * e * e / (1.0 + e), factor * e * e * (3.0 + 2.0 * e) / ((1.0 + e) * (1.0 + e))};
  }

 private:
  double conductivity_ = 1e-9;  // [m/s]
  double reference_ = 0.0;      // [-]
};

}  // namespace mudline
