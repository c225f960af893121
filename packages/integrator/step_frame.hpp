#pragma once

#include <functional>
#include <vector>

#include "framework/constraints.hpp"
#include "framework/term.hpp"
#include "integrator/levels.hpp"
#include "integrator/time_scheme.hpp"

namespace mudline {

/// Definition of one step.
struct StepRequest {
  double dt;  // [s]
  TimeScheme scheme;
  /// Prescribed unknowns at the end of the step.
  std::function<void(double t_old, double t_end, const State& committed, Constraints&)> prescribe;
};

/// The request of an evaluation at rest: no time passes, and nothing is prescribed.
StepRequest standing_still(bool inertia);

/// What terms see of one step: the view with the levels of an iterate, and the prescribed unknowns. It fills the trial
/// state; the committed one is only read.
class StepFrame {
 public:
  /// Both must outlive it.
  StepFrame(const Space& space, StateStore& store);

  /// Begins a trial state and fills the view, but for the levels.
  void prepare(const StepRequest& request, StepView::Kind kind);
  /// Finds the prescribed unknowns of the step, and the pressure of the water outside open ones. Collective.
  void constrain(const StepRequest& request);
  /// The committed unknowns, with the prescribed ones at the end of the step.
  Vector start() const;
  /// Fills the levels and the nodal part of the trial state from the unknowns x. Collective.
  void move_to(const Vector& x);
  /// Sets all levels to the committed state, with zero accelerations and first-order rates; sensitivities are to these
  /// only.
  void rest();
  /// Counts a linearisation of the step.
  void linearised() { ++view_.linearisation; }
  /// Share of elastic stiffness in the next tangents of soil laws, in [0, 1).
  void set_elastic_share(double share) { view_.elastic_share = share; }

  const StepView& view() const { return view_; }
  const TimeScheme& scheme() const { return scheme_; }
  const Constraints& constraints() const { return constraints_; }
  /// What the matrix depends on apart from the state: step size, scheme and free unknowns.
  std::vector<double> matrix_key() const;

 private:
  void set_sensitivities();
  /// Finds the pressure of the water outside open unknowns at the balance level. Collective.
  void find_outside(const StepRequest& request);

  const Space& space_;
  StateStore& store_;
  StepView view_;
  TimeScheme scheme_;
  Constraints constraints_;
  NodalView outside_;  // pressure of the water outside at the balance level [Pa]
  Levels levels_;
};

}  // namespace mudline
