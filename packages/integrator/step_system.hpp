#pragma once

#include <functional>
#include <string>
#include <vector>

#include "algebra/linear_solver.hpp"
#include "framework/constraints.hpp"
#include "framework/term_faces.hpp"
#include "integrator/chord.hpp"
#include "integrator/convergence.hpp"
#include "integrator/elastic_share.hpp"
#include "integrator/forcing.hpp"
#include "integrator/levels.hpp"
#include "integrator/newton.hpp"
#include "integrator/time_scheme.hpp"

namespace mudline {

/// Definition of one step.
struct StepRequest {
  double dt;  // [s]
  TimeScheme scheme;
  /// Prescribed unknowns at the end of the step.
  std::function<void(double t_old, double t_end, const State& committed, Constraints&)> prescribe;
};

/// Wall-clock seconds of this rank spent so far.
struct StepTimes {
  double residual = 0, jacobian = 0, linear = 0;
};

/// The nonlinear system of one step: the sum of the active terms, evaluated at the integrator's levels. It translates
/// between the unknown x (the value at the end of the step) and the levels that terms see, and fills the trial state;
/// the committed one is only read.
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

  /// Begins the computation of rates at the start of `request`: evaluates the terms at the committed state with zero
  /// accelerations and first-order rates. Returns false if they cannot be evaluated. Collective.
  bool begin_rates(const StepRequest& request);
  /// Assembles the matrix of inertia and storage, from the terms that are not history terms.
  const CrsMatrix& rate_matrix();
  /// Solves for the rates and accelerations of the unknowns that are not constrained. Collective.
  bool solve_rates(double tolerance, Vector& rates);

  /// Restores the linear solver from solver_memory() of the run that is continued.
  void restore_solver(const std::vector<double>& memory);
  /// Data for restore_solver(): the solver's memory and the state of the chord control. Afterwards this run continues
  /// exactly as a restarted one would.
  std::vector<double> solver_memory();

  // Results of the last evaluation; after a step they stay until the next one begins.
  const StepView& view() const { return view_; }
  const TimeScheme& scheme() const { return scheme_; }
  const std::vector<Term*>& active() const { return active_; }
  const std::vector<Reports*>& reports() const { return reports_; }
  const std::vector<Unilateral*>& unilateral() const { return unilateral_; }
  /// Largest step that the active terms accept from the committed state, at most `dt` [s]. Collective.
  double step_limit(double dt) const;
  /// Why the last evaluation, Jacobian or linear solve failed; "" if none did.
  const std::string& failure() const { return failure_; }
  /// Messages of the active terms about a failed last evaluation, "; ..." each; "" if there are none. Collective.
  std::string hints() const;
  /// Alpha-level contribution of active term k (history terms: interpolated), this rank's part, by overlap dof.
  NodalView term_force(int k) const { return force_[k]; }
  /// Index of the F_n of active term k in State::history_forces; -1 where it has none.
  int history_slot(int k) const;
  /// Sum over the terms at constrained dofs: the reaction, this rank's part; zero elsewhere.
  NodalView reaction() const { return reaction_; }
  const Constraints& constraints() const { return constraints_; }
  const Space& space() const { return space_; }
  StateStore& store() const { return store_; }
  Convergence& convergence() { return convergence_; }
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
  void prepare_view(const StepRequest& request, StepView::Kind kind);
  void set_sensitivities();
  void constrain(const StepRequest& request);
  /// Finds the pressure of the water outside open unknowns at the balance level. Collective.
  void find_outside(const StepRequest& request);
  /// Fills the level views and the trial's nodal part from x.
  void levels(const Vector& x);
  /// Sets all levels to the committed state, with zero accelerations and first-order rates; sensitivities are to these
  /// only.
  void levels_at_rest();
  /// Discards the present Jacobian if the coming step has another step size, scheme or set of free unknowns.
  void check_chord();
  /// Whether the trial state was last evaluated at exactly x. Collective.
  bool is_evaluated_at(const Vector& x) const;
  /// Returns the number of points on this rank where a term failed.
  int evaluate_terms();
  /// Evaluates Term::residual into `force` through `to`; a term that throws or returns a non-finite value counts as
  /// failed.
  int evaluate_term(Term& term, const NodalView& force, const ResidualView& to);
  /// Assembles the matrices of all active terms. Returns false, with the reason in failure_, where a term throws on
  /// some rank. Collective.
  bool add_matrices();

  const Space& space_;
  StateStore& store_;
  std::vector<Term*> terms_, active_;
  std::vector<int> history_slot_;        // by term: index of its F_n, -1
  std::vector<History*> history_;        // by slot
  std::vector<Unilateral*> unilateral_;  // faces of the active terms, like the next two
  std::vector<Foresees*> foresees_;
  std::vector<Reports*> reports_;
  LinearSolver& solver_;
  std::function<BlockData(const StepView&)> block_data_;
  Assembler assembler_;
  StepView view_;
  TimeScheme scheme_;
  Constraints constraints_;
  Convergence convergence_;
  Levels levels_;
  NodalView reaction_, total_, acting_, whole_, passing_;
  NodalView outside_;  // pressure of the water outside at the balance level
  std::vector<NodalView> force_;
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
