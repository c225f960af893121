#pragma once

#include "physics/conditions/held_forces.hpp"
#include "physics/conditions/side_terms.hpp"

namespace mudline {

/// Holds a side set as it is when the condition becomes active: constant forces at its nodes balance everything that
/// acts there then, stresses, weight and loads. In the first geostatic stage these are the tractions of the initial
/// state, as along a hole that a body fills. A stage that does not name it releases the set.
class InSituSupport : public SideLoad {
 public:
  void parameters(Parameters& p) { declare_set(p); }
  bool may_hold() override { return false; }
  bool supports() const override { return true; }
  void declare_state(StateStore& store) override {
    // the mesh does not move in the stages in which it acts
    held_.declare(store, name(), *space_, space_->find(field_name()), set_, Transfer::nearest);
  }
  void activate(const State&, const NodalView& unbalanced) override { held_.take(unbalanced); }
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView&, Assembler&, double) override {}

 protected:
  std::string kind() const override { return "in-situ support"; }

 private:
  int columns() const override { return 0; }
  HeldForces held_;
};

}  // namespace mudline
