#pragma once

#include <limits>

#include "core/entry.hpp"
#include "materials/fluid.hpp"

namespace mudline {

/// Water, fresh unless the deck says otherwise; slightly compressible or incompressible.
class Water : public Fluid {
 public:
  void parameters(Parameters& p) {
    p.add("density", density_, "kg/m3", positive(), "Mass density of the pore fluid");
    p.add("bulk modulus", bulk_modulus_, "Pa", positive(), "Compressibility of the pore fluid, with any air it holds");
    p.add("incompressible", incompressible_, "No compressibility; a bulk modulus is then refused");
    p.add("unit weight", unit_weight_, "N/m3", non_negative(),
          "Weight that turns hydraulic conductivity into mobility; 0: density times 9.81 m/s2");
  }
  void check(const Section& section) const {
    if (incompressible_ && section.has_parameter("bulk modulus") &&
        !apart(section.source("incompressible"), section.source("bulk modulus")))
      section.fail("has no effect beside 'incompressible' = true; remove one of them", "bulk modulus");
  }
  double density() const override { return density_; }
  double bulk_modulus() const override {
    return incompressible_ ? std::numeric_limits<double>::infinity() : bulk_modulus_;
  }
  double unit_weight() const override { return unit_weight_ > 0.0 ? unit_weight_ : 9.81 * density_; }

 private:
  double density_ = 1000.0;      // [kg/m3]
  double bulk_modulus_ = 2.2e9;  // [Pa]
  bool incompressible_ = false;
  double unit_weight_ = 0.0;  // [N/m3]
};

}  // namespace mudline
