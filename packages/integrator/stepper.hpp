#pragma once

#include <functional>
#include <string>
#include <vector>

#include "algebra/linear_solver.hpp"
#include "framework/constraints.hpp"
#include "framework/term_faces.hpp"
#include "integrator/chord.hpp"
#include "integrator/convergence.hpp"
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

/// Outcome of an attempted step.
struct StepReport {
  bool converged = false;
  bool refused = false;       // a term refused the step, though Newton's method converged
  int newton_iterations = 0;  // over all solves of the step
  int hardest_solve = 0;      // largest number of iterations of one solve
  int augmentations = 0;      // solves after the first, for terms that augment
  int linear_iterations = 0;
  int factorisations = 0;
  std::string reason;
};

/// Wall-clock seconds of this rank spent so far.
struct StepTimes {
  double residual = 0, jacobian = 0, linear = 0;
};

/// One step as a transaction: begin (predictor, search) -> Newton on pure evaluations -> accept or nothing. Translates
/// between the unknown x (the value at n+1) and the levels that terms see.
class Stepper : public NonlinearProblem {
 public:
  /// Registers the terms' arrays and sparsity. `terms` must outlive the stepper; blocks supplies preconditioner data.
  Stepper(const Space& space, StateStore& store, std::vector<Term*> terms, LinearSolver& solver,
          std::function<BlockData(const StepView&)> block_data);

  /// Sets the terms that act in the present stage, a subset of the constructor's. refresh_history() must follow before
  /// a step.
  void activate(const std::vector<Term*>& active);
  /// Evaluates F_n of all active history terms at the committed state. Returns false if it cannot be evaluated.
  bool refresh_history();
  /// Residual of the committed state under static loads (no inertia, no flow), by overlap dof, summed over ranks.
  NodalView static_residual();
  /// Messages of the active terms about a failed last evaluation, "; ..." each; "" if there are none. Collective.
  std::string hints() const;
  /// Accelerations and first-order rates that satisfy the equations of motion at the committed state (start of a
  /// dynamic stage). Fields whose rate matrix is singular (incompressible constituents) keep the rate zero.
  bool initialise_rates(const StepRequest& request, double linear_tolerance);

  /// Measures whether the committed rates continue into a stage: the ratio of two relative imbalances at the end of a
  /// step without inertia under its loads and motions, one with the committed rates and one at rest. It is small where
  /// something moves and the rates are its velocities, infinite where nothing moves and the rates are remnants of
  /// earlier loads, and 1 where it cannot be evaluated. Collective.
  double misfit_of_rates(const StepRequest& request, const StepTolerances& tolerances);

  /// Restores the linear solver from solver_memory() of the run that is continued.
  void restore_solver(const std::vector<double>& memory);
  /// Data for restore_solver(): the solver's memory and the state of the chord control. Afterwards this run continues
  /// exactly as a restarted one would.
  std::vector<double> solver_memory();

  /// First half of an attempt: predictor, prescribed unknowns, the terms' begin. Afterwards residual() and jacobian()
  /// may be called for any x. Returns the initial guess.
  Vector begin(const StepRequest& request, const StepTolerances& tolerances);

  /// Tries one step from the committed state, with full Newton steps and, where those do not converge, with damped
  /// ones; on success the trial state is complete. The committed state is untouched.
  StepReport attempt(const StepRequest& request, const StepTolerances& tolerances, const NewtonOptions& newton);

  // Results for the balances after a successful attempt, before or after acceptance.
  const StepView& view() const { return view_; }
  const std::vector<Term*>& active() const { return active_; }
  const std::vector<Reports*>& reports() const { return reports_; }
  /// Largest step that the active terms accept from the committed state, at most `dt` [s]. Collective.
  double step_limit(double dt) const;
  /// Alpha-level contribution of active term k (history terms: interpolated), this rank's part, by overlap dof.
  NodalView term_force(int k) const { return force_[k]; }
  /// Index of the F_n of active term k in State::history_forces; -1 where it has none.
  int history_slot(int k) const;
  /// Sum over the terms at constrained dofs: the reaction, this rank's part; zero elsewhere.
  NodalView reaction() const { return reaction_; }
  const Constraints& constraints() const { return constraints_; }
  const Space& space() const { return space_; }
  StateStore& store() { return store_; }
  const Assembler& assembler() const { return assembler_; }
  const StepTimes& times() const { return times_; }
  Convergence& convergence() { return convergence_; }

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
  bool at_rounding() const override { return convergence_.at_rounding(); }
  void observe(double worst) override;

 private:
  /// Linear prediction: where prescribed unknowns move or a term asks for it, replaces the guess `x` by the linear
  /// response of the committed state. Otherwise all other unknowns would stay behind, and a large motion would fold or
  /// yield the elements in between. Returns false where it leaves x unchanged.
  bool predict(Vector& x);
  bool predict_linear(Vector& x, bool always);
  /// Extrapolates the guess with the committed rates. Returns false, with x unchanged, where nothing moves, where the
  /// terms cannot be evaluated there, or where the imbalance is larger.
  bool extrapolate(Vector& x);
  /// x after a step at the committed rates; prescribed unknowns stay as they are.
  Vector extrapolated(const Vector& x) const;
  /// Whether the forces of the committed state at rest (the last evaluation) equal its stored F_n. Soil whose strength
  /// depends on the strain rate relaxes at rest; its response there does not apply to a motion.
  bool rests() const;
  /// Discards the present Jacobian if the coming step has another step size, scheme or set of free unknowns.
  void check_chord();
  /// Whether the trial state was last evaluated at exactly x. Collective.
  bool is_evaluated_at(const Vector& x) const;
  /// One attempt with these Newton options only, without a damped retry.
  StepReport try_step(const StepRequest& request, const StepTolerances& tolerances, const NewtonOptions& newton);
  /// Solves from x, repeatedly where terms augment; on convergence the trial state belongs to x, bit for bit.
  void solve_step(const NewtonOptions& newton, Vector& x, StepReport& report);
  /// Augmentation of all active terms. Collective.
  Augmentation augment(int count);
  void prepare_view(const StepRequest& request, StepView::Kind kind);
  void set_sensitivities();
  void constrain(const StepRequest& request);
  /// Fills the level views and the trial's nodal part from x.
  void levels(const Vector& x);
  /// Sets all levels to the committed state, with zero accelerations and first-order rates; sensitivities are to these
  /// only.
  void levels_at_rest();
  /// Assembles the matrix of inertia and storage from the terms that are not history terms.
  void add_rate_matrices();
  /// Prescribes the fields whose rate matrix has a zero row, so that it is singular. Returns whether there are any.
  bool hold_fields_without_rates();
  /// Does the work of residual(). `jacobian_follows`: whether a new Jacobian at x is likely to follow.
  bool evaluate(const Vector& x, bool jacobian_follows, Vector& f);
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
  std::vector<Unilateral*> unilateral_;  // faces of the active terms, like the next three
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
  NodalView reaction_, total_, acting_, whole_;
  std::vector<NodalView> force_;
  std::string failure_;
  int linear_iterations_ = 0, factorisations_ = 0;
  StepTimes times_;
  ChordControl chord_;
  Forcing forcing_;
  std::vector<double> enough_;   // tolerances of the next linear solve, see LinearTolerance
  Vector evaluated_, balance_;   // unknowns of the trial state and their residual
  bool evaluated_at_x_ = false;  // whether the trial state still belongs to evaluated_
};

}  // namespace mudline
