#pragma once

// Included by newton.cpp only, because it names NOX classes.

#include <NOX_LineSearch_Generic.H>
#include <NOX_LineSearch_UserDefinedFactory.H>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "integrator/nox_interface.hpp"

namespace mudline {

/// Full Newton steps, shortened where one of these is seen:
/// - the residual cannot be evaluated (a folded element, a soil law that fails): halved;
/// - a largest growth is given, and the residual grows by more than that while it is large, or oscillates near the end:
///   halved. The limit is optional: residuals may rise in iterations with contact and friction, where a line search
///   that requires descent would take tiny steps;
/// - full steps alternate between two states of contact or yielding: half a step leads to the state between both;
/// - without a largest growth, after some iterations the residual of the forces is still large, and the step goes far
///   beyond the place where they do no work along it: cut to that place, as a secant finds it. Elastic-plastic soil
///   stores energy or takes it, so the work falls along a step, and the place is that of the least energy.
class GuardedStep : public NOX::LineSearch::Generic {
 public:
  GuardedStep(double largest_growth, int halvings) : largest_growth_(largest_growth), halvings_(halvings) {}
  bool compute(NOX::Abstract::Group& group, double& step, const NOX::Abstract::Vector& direction,
               const NOX::Solver::Generic& solver) override {
    const auto& old = dynamic_cast<const NoxGroup&>(solver.getPreviousSolutionGroup());
    auto& at = dynamic_cast<NoxGroup&>(group);
    norms_.push_back(old.getNormF());
    step = share_to_go(old, at, direction);
    before_ = direction.clone(NOX::DeepCopy);
    return true;
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

  /// The share of the step that is taken; `at` is evaluated there.
  double share_to_go(const NoxGroup& old, NoxGroup& at, const NOX::Abstract::Vector& direction) const {
    double step = 1;
    bool cut = false;
    for (int halving = 0;; ++halving, step *= 0.5) {
      at.computeX(old, direction, step);
      const double now =
          at.computeF() == NOX::Abstract::Group::Ok ? at.getNormF() : std::numeric_limits<double>::quiet_NaN();
      if (halving == halvings_) return step;
      if (!std::isfinite(now) || (step == 1 && alternates(now, direction))) continue;
      const double share = cut ? 1 : share_without_work(old, at, now, direction);
      if (share < 1) {
        cut = true;
        step *= 2 * share;  // and is halved
      } else if (largest_growth_ == 0 || tame(now, old.getNormF())) {
        return step;
      }
    }
  }
  int iterations() const { return static_cast<int>(norms_.size()); }

  /// Whether the residual has not grown too much. Both norms are relative to what acts at the new iterate.
  bool tame(double now, double before) const {
    return now <= near_ ? iterations() < patience_ || now <= before : now <= largest_growth_ * before;
  }
  /// Whether the step undoes the one before, and the residual of the new iterate and that of the one before repeat
  /// those of two iterations before, and are large.
  bool alternates(double now, const NOX::Abstract::Vector& direction) const {
    constexpr double same = 0.01, opposite = -0.9;  // cosine
    const std::size_t n = norms_.size();
    if (n < 3 || !(now > near_)) return false;
    if (std::abs(now - norms_[n - 2]) > same * now || std::abs(norms_[n - 1] - norms_[n - 3]) > same * now)
      return false;
    return direction.innerProduct(*before_) < opposite * direction.norm() * before_->norm();
  }
  /// Share of the step at whose end no work is done along it, if the step is to be cut there; else 1. `now`: norm of
  /// the residual at its end, `at`.
  double share_without_work(const NoxGroup& old, const NoxGroup& at, double now,
                            const NOX::Abstract::Vector& direction) const {
    constexpr int full_steps = 4;                // at least
    constexpr double beyond = 0.5, least = 0.1;  // work at the end over that at the start, from which the step is cut
    if (largest_growth_ > 0 || iterations() <= full_steps || !(now > near_)) return 1;
    const double start = old.work(direction), end = at.work(direction);
    return start < 0 && end > -beyond * start ? std::max(start / (start - end), least) : 1;
  }

  double largest_growth_;
  int halvings_;
  std::vector<double> norms_;                // of the residuals of all iterates so far
  RCP<const NOX::Abstract::Vector> before_;  // direction of the iteration before
};

}  // namespace mudline
