#pragma once

#include "core/parameters.hpp"

namespace mudline {

/// Pore fluid with constant density in momentum and linear compressibility in storage.
class Fluid {
 public:
  virtual ~Fluid() = default;
  virtual double density() const = 0;       // [kg/m3]
  virtual double bulk_modulus() const = 0;  // [Pa]; infinite for an incompressible fluid
  virtual double unit_weight() const = 0;   // [N/m3] converts hydraulic conductivity to mobility k/gamma_w
};

}  // namespace mudline
