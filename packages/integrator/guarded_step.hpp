#pragma once

// Included by newton.cpp only, because it names NOX classes.

#include <NOX_LineSearch_Generic.H>
#include <NOX_LineSearch_UserDefinedFactory.H>

#include <cmath>

#include "integrator/nox_interface.hpp"

namespace mudline {

/// Full Newton steps, halved where the residual cannot be evaluated (a folded element, a soil law that fails) and, if a
/// largest growth is given, where it grows by more than that while it is large, or oscillates near the end. The growth
/// limit is optional: residuals may rise in iterations with contact and friction, where a line search that requires
/// descent would take tiny steps.
class GuardedStep : public NOX::LineSearch::Generic {
 public:
  GuardedStep(double largest_growth, int halvings) : largest_growth_(largest_growth), halvings_(halvings) {}
  bool compute(NOX::Abstract::Group& group, double& step, const NOX::Abstract::Vector& direction,
               const NOX::Solver::Generic& solver) override {
    const NOX::Abstract::Group& old = solver.getPreviousSolutionGroup();
    step = 1;
    for (int halving = 0;; ++halving, step *= 0.5) {
      group.computeX(old, direction, step);
      const bool evaluated = group.computeF() == NOX::Abstract::Group::Ok && std::isfinite(group.getNormF());
      // both norms are relative to what acts at the new iterate
      const double now = evaluated ? group.getNormF() : 0.0, before = old.getNormF();
      const bool cycles = solver.getNumIterations() >= patience_ && now > before;
      const bool tame =
          evaluated && (largest_growth_ == 0 || (now <= near_ ? !cycles : now <= largest_growth_ * before));
      if (tame || halving == halvings_) return true;
    }
  }

  class Factory : public NOX::LineSearch::UserDefinedFactory {
   public:
    Factory(double largest_growth, int halvings) : largest_growth_(largest_growth), halvings_(halvings) {}
    RCP<NOX::LineSearch::Generic> buildLineSearch(const RCP<NOX::GlobalData>&, Teuchos::ParameterList&) const override {
      return rcp(new GuardedStep(largest_growth_, halvings_));
    }

   private:
    double largest_growth_;
    int halvings_;
  };

 private:
  // Residual ratio below which single points that open or slip may raise the residual. After `patience_` iterations
  // they are taken to oscillate between two states, and half a step is closer to both.
  static constexpr double near_ = 100;
  static constexpr int patience_ = 6;
  double largest_growth_;
  int halvings_;
};

}  // namespace mudline
