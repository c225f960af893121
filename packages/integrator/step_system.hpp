#pragma once

#include <functional>
#include <string>
#include <vector>

#include "algebra/linear_solver.hpp"
#include "integrator/acting_terms.hpp"
#include "integrator/chord.hpp"
#include "integrator/convergence.hpp"
#include "integrator/elastic_share.hpp"
#include "integrator/forcing.hpp"
#include "integrator/newton.hpp"
#include "integrator/step_frame.hpp"

namespace mudline {

/// Wall-clock seconds of this rank spent so far.
struct StepTimes {
  double residual = 0, jacobian = 0, linear = 0;
};

/// The nonlinear system of one step: the sum of the active terms, evaluated at the integrator's levels, and the linear
/// systems of its iterations. Its frame translates between the unknown x (the value at the end of the step) and the
/// levels that terms see; its terms give forces and matrices. It fills the trial state; the committed one is only read.
class StepSystem : public NonlinearProblem {
 public:
  /// Registers the terms' arrays and sparsity. `space`, `store`, `terms` and `solver` must outlive it; `block_data`
  /// supplies preconditioner data.
  StepSystem(const Space& space, StateStore& store, std::vector<Term*> terms, LinearSolver& solver,
             std::function<BlockData(const StepView&)> block_data);

  /// Sets the terms that act in the present stage, a subset of the constructor's. refresh_history() must follow before
  /// a step.
  void activate(const std::vector<Term*>& active);
  /// Evaluates F_n of all active history terms at the committed state. Returns false if it cannot be evaluated.
  bool refresh_history();
  /// Residual of the committed state under static loads (no inertia, no flow), by overlap dof, summed over ranks.
  NodalView static_residual();

  /// Begins a step: the terms' begin, prescribed unknowns. Afterwards residual() and jacobian() may be called for any
  /// x. Returns the committed unknowns, with the prescribed ones at the end of the step.
  Vector begin(const StepRequest& request, const StepTolerances& tolerances);
  /// Begins another solve within the step, after an augmentation of terms.
  void start_solve();
  /// Sets how Jacobians are formed and reused, and how far linear systems are solved.
  void set_options(const NewtonOptions& newton);
  /// Does the work of residual(). `jacobian_follows`: whether a new Jacobian at x is likely to follow.
  bool evaluate(const Vector& x, bool jacobian_follows, Vector& f);
  /// The next residual() evaluates the terms, even where x is that of the last evaluation.
  void forget_evaluation() { evaluated_at_x_ = false; }
  /// The next jacobian() assembles the matrix.
  void forget_jacobian() { chord_.forget(); }
  /// Completes the trial state of a step that has converged (see Completes); false, with the reason in failure(), where
  /// that fails. Collective.
  bool complete();
  /// Forgets all that was learnt from earlier linear solves.
  void forget_solver();
  /// Solves once, with the matrix that the terms assembled last; solves before and after know nothing of it. False
  /// where it does not converge. Collective.
  bool solve_apart(const Vector& right, double tolerance, Vector& x);

  /// The next linear solve may leave as much of the residual f as forcing allows at most.
  void solve_roughly(const Vector& f);

  /// Restores the linear solver from solver_memory() of the run that is continued.
  void restore_solver(const std::vector<double>& memory);
  /// Data for restore_solver(): the solver's memory and the state of the chord control. Afterwards this run continues
  /// exactly as a restarted one would.
  std::vector<double> solver_memory();

  /// The parts; after a step they keep the results of its last evaluation until the next one begins.
  StepFrame& frame() { return frame_; }
  ActingTerms& terms() { return terms_; }
  const ActingTerms& terms() const { return terms_; }
  Convergence& convergence() { return convergence_; }
  const StepView& view() const { return frame_.view(); }
  const TimeScheme& scheme() const { return frame_.scheme(); }
  const Constraints& constraints() const { return frame_.constraints(); }
  const Space& space() const { return space_; }
  StateStore& store() const { return store_; }
  /// Why the last evaluation, Jacobian or linear solve failed; "" if none did.
  const std::string& failure() const { return failure_; }
  /// Messages of the active terms about a failed last evaluation, "; ..." each; "" if there are none. Collective.
  std::string hints() const { return terms_.hints(view()); }
  /// Iterations of linear solves, and factorisations, in the present step.
  int linear_iterations() const { return linear_iterations_; }
  int factorisations() const { return factorisations_; }
  const StepTimes& times() const { return times_; }
  /// Goes on counting from the times of the system on the mesh of before.
  void continue_times(const StepTimes& before) { times_ = before; }

  // NonlinearProblem
  RCP<const Map> map() const override { return space_.dofs()->owned(); }
  bool residual(const Vector& x, Vector& f) override;
  bool jacobian(const Vector& x) override;
  void apply_jacobian(const Vector& v, Vector& jv) override;
  bool solve(const Vector& f, Vector& dx) override;
  std::vector<double> residual_ratios(const Vector& f) override { return convergence_.residual_ratios(f); }
  std::vector<double> update_ratios(const Vector& dx, const Vector& x) override {
    return convergence_.update_ratios(dx, x);
  }
  std::string place_of_largest(const Vector& f) const override { return convergence_.place_of_largest(f); }
  bool at_rounding() const override { return convergence_.at_rounding(); }
  double work(const Vector& f, const Vector& dx) override;
  void observe(double worst) override;

 private:
  /// Begins an evaluation of the terms at the committed state, at rest. Collective.
  void begin_rest();
  /// Discards the present Jacobian if the coming step has another step size, scheme or set of free unknowns.
  void check_chord();
  /// Whether the trial state was last evaluated at exactly x. Collective.
  bool is_evaluated_at(const Vector& x) const;
  void use_matrix();
  /// The next linear solve may leave this share of a residual whose worst ratio is `worst`. Each field is solved as far
  /// as the worst one needs. 0: it is solved to the linear tolerance.
  void leave(double share, double worst);

  const Space& space_;
  StateStore& store_;
  LinearSolver& solver_;
  std::function<BlockData(const StepView&)> block_data_;
  ActingTerms terms_;
  StepFrame frame_;
  Convergence convergence_;
  std::string failure_;
  int linear_iterations_ = 0, factorisations_ = 0;
  StepTimes times_;
  ChordControl chord_;
  Forcing forcing_;
  ElasticShare elastic_share_;
  std::vector<double> enough_;   // tolerances of the next linear solve, see LinearTolerance
  Vector evaluated_, balance_;   // unknowns of the trial state and their residual
  bool evaluated_at_x_ = false;  // whether the trial state still belongs to evaluated_
};

}  // namespace mudline
