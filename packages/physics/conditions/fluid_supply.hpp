#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/condition.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// Water that enters saturated soil everywhere in a region, as volume per initial volume of soil and time [1/s]. A
/// negative supply takes water out.
class FluidSupply : public Condition, public Term {
 public:
  void parameters(Parameters& p);
  void bind(const ConditionContext& context, const Section& section) override;
  Term* term() override { return this; }
  bool may_hold() override { return false; }
  std::string name() const override { return "fluid supply/" + Condition::name; }
  Role role() const override { return Role::exchange; }
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView&, Assembler&, double) override {}

 private:
  struct Part {
    const SoilBlock* block;
    PointView rate;  // (point, 0) [1/s]
  };
  std::string region_;
  Function rate_;
  std::shared_ptr<const Soil> soil_;
  std::vector<Part> parts_;
};

/// The soil of a model in which water may be supplied inside. InputError through `section` where there is no pore
/// water, or where the water would need a temperature.
std::shared_ptr<const Soil> supplied_soil(const ConditionContext& context, const Section& section);

}  // namespace mudline
