#pragma once

#include <memory>

#include "framework/term.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// Mass balance of the pore fluid on the configuration of the alpha level:
///   R_p = int Np^T [alpha div v + pdot/Q] dv + int grad(Np)^T kappa (grad p - rho_f g [+ rho_f a]) dv,
///   kappa = k(e)/gamma_w.
/// p: compression positive, outflow positive. In a geostatic stage the pore pressures are prescribed and the term is
/// zero.
class FluidMass : public Term {
 public:
  FluidMass(std::shared_ptr<Soil> soil, bool fluid_acceleration)
      : soil_(std::move(soil)), fluid_acceleration_(fluid_acceleration) {}
  std::string name() const override { return "fluid mass"; }
  Role role() const override { return Role::balance; }
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;

 private:
  /// Calls f(block, law of balance).
  template <class F>
  void for_each_block(const StepView& view, F&& f) const;
  std::shared_ptr<Soil> soil_;
  bool fluid_acceleration_;
};

}  // namespace mudline
