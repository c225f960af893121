#pragma once

#include <string>
#include <vector>

#include "framework/condition.hpp"
#include "framework/side_block.hpp"

namespace mudline {

/// A load term on the sides of a set: finds the sides, and evaluates functions at their quadrature points.
class SideLoad : public Condition, public Term {
 public:
  void bind(const ConditionContext& context, const Section& section) override;
  Term* term() override { return this; }
  std::string name() const override { return kind() + "/" + Condition::name; }
  void sparsity(Assembler& assembler) override {
    for (Part& part : parts_) part.block.group = assembler.add_group(part.block.dofs);
  }

 protected:
  virtual std::string kind() const = 0;
  virtual std::string field_name() const { return "displacement"; }
  void declare_set(Parameters& p);
  /// The sides of one shape.
  struct Part {
    SideBlock block;
    PointView load;          // (side * points + q, columns of the load)
    std::vector<int> sides;  // their numbers in the set, on this rank
  };
  /// Fills one column of the load tables with values of a function at the quadrature points.
  void tabulate(const Function& function, double time, const ConstCoordinateView& x, int column) const;
  ConstCoordinateView initial() const { return space_->mesh().coordinates(); }
  Geometry geometry() const { return space_->mesh().geometry(); }
  int dimension() const { return space_->mesh().dimension(); }

  std::string set_;
  const Space* space_ = nullptr;
  std::vector<Part> parts_;

 private:
  virtual int columns() const = 0;
};

/// Force per current area, fixed direction (tension positive on an outward face).
class Traction : public SideLoad {
 public:
  void parameters(Parameters& p);
  bool may_hold() override { return false; }
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;

 protected:
  std::string kind() const override { return "traction"; }

 private:
  int columns() const override { return 2 * dimension(); }  // components now, at the step's start [Pa]
  void tabulate_components(const StepView& view) const;
  std::array<Function, axis_names.size()> component_;
};

/// Pressure that follows the current surface; positive pushes against the body. It is a function of the point's initial
/// position, or of its present one (for water in a hole that a body opens, say); then the tangent includes its
/// gradient, by central differences.
class SurfacePressure : public SideLoad {
 public:
  void parameters(Parameters& p);
  bool may_hold() override { return false; }
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;

 protected:
  std::string kind() const override { return "pressure"; }

 private:
  enum class Position { initial, present };
  int columns() const override { return 2 + dimension(); }  // value now, at the step's start [Pa]; gradient [Pa/m]
  void tabulate_values(const StepView& view) const;
  void tabulate_gradient(const StepView& view) const;

  Function value_;
  Position position_ = Position::initial;
};

/// Prescribed outward discharge [m/s] of a scalar field (pore water by default; for another field its flux density).
class NormalFlux : public SideLoad {
 public:
  void parameters(Parameters& p);
  Role role() const override { return Role::exchange; }
  bool may_hold() override { return false; }
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView&, Assembler&, double) override {}

 protected:
  std::string kind() const override { return "flux"; }
  std::string field_name() const override { return name_; }

 private:
  int columns() const override { return 1; }  // outward [m/s]
  std::string name_ = "pore pressure";
  Function value_;
};

}  // namespace mudline
