#pragma once

#include <string>
#include <vector>

#include "framework/condition.hpp"

namespace mudline {

/// A well: water that enters saturated soil at a point, or along a straight line of nodes, evenly by length. The radius
/// of the well is not resolved: the pore pressure at its nodes depends on the size of the elements.
class Well : public Condition, public Term {
 public:
  void parameters(Parameters& p);
  void bind(const ConditionContext& context, const Section& section) override;
  Term* term() override { return this; }
  bool may_hold() override { return false; }
  std::string name() const override { return "well/" + Condition::name; }
  Role role() const override { return Role::exchange; }
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView&, Assembler&, double) override {}

 private:
  struct Share {
    int dof;       // overlap dof of an owned node's pore pressure
    double share;  // of the discharge [-]
  };
  std::string set_;
  Function discharge_;
  std::vector<Share> shares_;
};

/// Share in a straight line's length of each of some points: half of the distances to its neighbours over the length of
/// all; 1 for a single point. Points: x, y, z one after the other. Returns "" or why there is no such line.
std::string shares_of_line(const std::vector<double>& points, std::vector<double>& shares);

}  // namespace mudline
