#pragma once

#include <vector>

#include "physics/conditions/held_forces.hpp"
#include "physics/conditions/side_terms.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// Viscous boundary (Lysmer and Kuhlemeyer 1969): traction -(rho c_p v_n n + rho c_s v_t) on a side set, with the
/// elastic wave speeds of the adjacent soil in the committed state; saturated soil uses the undrained c_p. While active
/// it also applies the reaction that the boundary had when it was activated (the static earth pressure), so that a
/// stage may release the rollers of a geostatic stage without a jump.
class AbsorbingBoundary : public SideLoad {
 public:
  void parameters(Parameters& p);
  void bind(const ConditionContext& context, const Section& section) override;
  bool may_hold() override { return false; }
  std::string holds() const override { return set_; }
  void activate(const State&, const NodalView& unbalanced) override { held_.take(unbalanced); }
  void declare_state(StateStore& store) override {
    held_.declare(store, name(), *space_, space_->find(field_name()), set_, Transfer::total);
  }
  void begin(const StepView& view) override;
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;

 protected:
  std::string kind() const override { return "absorbing"; }

 private:
  int columns() const override { return 0; }  // the dashpots act on the committed configuration
  std::shared_ptr<Soil> soil_;
  double normal_factor_ = 1, tangential_factor_ = 1;
  std::vector<PointView> impedance_;  // by part: (side, normal and tangential) rho c [Pa s/m]
  HeldForces held_;
};

}  // namespace mudline
