#pragma once

#include <memory>
#include <vector>

#include "framework/term.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// Stabilises the pore pressure in linear cells, where pressure and displacement have the same nodes (equal order):
/// without it pressures may oscillate from node to node in undrained soil. Adds a storage of the deviation from the
/// element's mean,
///   R_p += int (q - mean q) (pdot - mean pdot) / (2 G) dv,
/// which conserves the water of every element and vanishes with the element's size. G: elastic shear modulus of the
/// element in the committed state; coordinates at the start of the step. Source: Bochev, Dohrmann and Gunzburger 2006,
/// SIAM J. Numer. Anal. 44; White and Borja 2008, CMAME 197.
class PressureProjection : public Term {
 public:
  explicit PressureProjection(std::shared_ptr<Soil> soil) : soil_(std::move(soil)) {}
  std::string name() const override { return "pressure projection"; }
  Role role() const override { return Role::balance; }
  void begin(const StepView& view) override;
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;

 private:
  /// Calls f(block, loop over its elements), unless the stage has no flow.
  template <class F>
  void for_each_block(const StepView& view, F&& f) const;
  std::shared_ptr<Soil> soil_;
  std::vector<PointView> matrices_;  // by block: (element, entry), of the present step [m3/Pa]
};

}  // namespace mudline
