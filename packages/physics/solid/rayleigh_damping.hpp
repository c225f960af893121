#pragma once

#include <memory>

#include "framework/term.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// R_u = (a M + b K_el) v: mass and elastic stiffness of the committed configuration and state (frozen during the step,
/// so the term is linear in v). Damping ratio of a mode: a/(2 w) + b w/2.
class RayleighDamping : public Term {
 public:
  RayleighDamping(std::shared_ptr<Soil> soil, double mass_factor, double stiffness_factor)
      : soil_(std::move(soil)), mass_factor_(mass_factor), stiffness_factor_(stiffness_factor) {}
  std::string name() const override { return "Rayleigh damping"; }
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;

 private:
  /// Calls f(block, level, law of balance).
  template <class F>
  void for_each_block(const StepView& view, F&& f) const;
  std::shared_ptr<Soil> soil_;
  double mass_factor_, stiffness_factor_;
};

}  // namespace mudline
