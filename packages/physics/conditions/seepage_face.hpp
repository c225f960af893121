#pragma once

#include <memory>
#include <vector>

#include "framework/term_faces.hpp"
#include "physics/conditions/side_terms.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// A surface open to the air: water leaves the soil where its pressure reaches zero, and none enters. In exact terms
/// p <= 0, outflow >= 0 and p times outflow = 0. Here the outflow is conductance * <p>, with a conductance many times
/// that of the cell behind the side, so that what is left of a pressure is small. Newton's method on this law finds the
/// wet part of the face as an active set does. History column: discharge/<name> [m3/s], outward.
class SeepageFace : public SideLoad, public Reports {
 public:
  void parameters(Parameters& p);
  void bind(const ConditionContext& context, const Section& section) override;
  Role role() const override { return Role::exchange; }
  bool may_hold() override { return false; }
  void begin(const StepView& view) override;
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;
  void histories(const StepView& view, Report& report) override;

 protected:
  std::string kind() const override { return "seepage face"; }
  std::string field_name() const override { return "pore pressure"; }

 private:
  int columns() const override { return 1; }  // conductance [m/(Pa s)]
  std::shared_ptr<const Soil> soil_;
  double factor_ = 1000;  // conductance over that of the cell behind the side [-]
};

}  // namespace mudline
