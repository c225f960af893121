#pragma once

#include <array>
#include <string>
#include <vector>

#include "framework/condition.hpp"

namespace mudline {

/// One side of the boundary with the dofs and nodes that a load on it touches.
struct LoadedSide {
  std::vector<int> nodes;  // two corners, then the middle of a quadratic side
  int block, element;
};

/// Quantities at a quadrature point of a side, on a given configuration.
struct SidePoint {
  double N[3], dN[3], Np[2];
  double tangent[2];       // dx/dxi [m]; the outward normal times ds/dxi is (tangent[1], -tangent[0])
  double r;                // [m] 1/(2 pi) in plane strain
  double weight;           // quadrature weight times 2 pi r
  Point initial, present;  // [m] positions, the argument of functions
};

/// A load term on the sides of a set: quadrature, scatter, group registration.
class SideLoad : public Condition, public Term {
 public:
  void bind(const ConditionContext& context, const Section& section) override;
  Term* term() override { return this; }
  std::string name() const override { return kind() + "/" + Condition::name; }
  void sparsity(Assembler& assembler) override;

 protected:
  virtual std::string kind() const = 0;
  virtual std::string field_name() const { return "displacement"; }
  void declare_set(Parameters& p);
  int side_dofs(const LoadedSide& side) const;
  /// Calls f(point) for the quadrature points of a side on configuration x.
  template <class F>
  void for_each_point(const LoadedSide& side, const ConstCoordinateView& x, F&& f) const {
    for (std::size_t q = 0; q < rule_.weights.size(); ++q) f(evaluate(side, x, rule_.points[q][0], rule_.weights[q]));
  }
  /// Adds a matrix over (nodes, 2) x (nodes, 2) of side `s`.
  void scatter(const MatrixScatter& to, int s, const double (&k)[6][6], double weight) const;

  std::string set_;
  const Space* space_ = nullptr;
  int field_ = -1, group_ = -1;
  bool axisymmetric_ = false;
  std::vector<LoadedSide> sides_;
  ElementDofs dofs_;  // (side, dof)
  QuadratureRule rule_;

 private:
  SidePoint evaluate(const LoadedSide& side, const ConstCoordinateView& x, double xi, double weight) const;
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
  Function component_[2];
};

/// Pressure that follows the current surface; positive pushes against the body. A function of the point's initial
/// position, or of its present one (of water in a hole that a body opens, say): then the tangent has its gradient, by
/// central differences.
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
  double value(double time, const SidePoint& p) const;
  std::array<double, 2> gradient(const StepView& view, const SidePoint& p) const;

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
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;

 protected:
  std::string kind() const override { return "flux"; }
  std::string field_name() const override { return name_; }

 private:
  std::string name_ = "pore pressure";
  Function value_;
};

}  // namespace mudline
