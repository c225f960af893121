#pragma once

#include <memory>
#include <vector>

#include "framework/term.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// The boundary of saturated soil that is open to water of a given pressure p_o (StepView::open).
///
/// Water flows in the soil as if its boundary had the pressure p_o. The vertex keeps a pressure of its own, because the
/// soil around it drains only in the time that its water takes to flow out. Its balance is
///   R_p = what is stored around it + C (p - p_o),  C = int grad(N) . kappa grad(N) dv,
/// with the conductivity kappa at the start of the step. So the soil at the boundary keeps its volume in a step that is
/// too short for it to drain, and p is p_o where nothing is stored. The difference between them is of second order in
/// the size of the elements, like the error of a linear pressure. It is Nitsche's form of a prescribed value. Source:
/// Nitsche 1971, Abh. Math. Sem. Univ. Hamburg 36.
class OpenBoundary : public Term {
 public:
  explicit OpenBoundary(std::shared_ptr<const Soil> soil) : soil_(std::move(soil)) {}
  std::string name() const override { return "open boundary"; }
  Role role() const override { return Role::balance; }
  void begin(const StepView& view) override;
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;

 private:
  /// Calls f(block, loop over its elements), unless the stage has no flow or no vertex is open.
  template <class F>
  void for_each_block(const StepView& view, F&& f) const;
  std::shared_ptr<const Soil> soil_;
  bool any_ = false;                    // whether a vertex of this rank is open in the present step
  std::vector<PointView> conductance_;  // by block: (element, vertex), of the present step [m3/(Pa s)]
};

}  // namespace mudline
