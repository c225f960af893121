#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "algebra/linear_solver.hpp"
#include "framework/constraints.hpp"
#include "framework/term_faces.hpp"
#include "integrator/chord.hpp"
#include "integrator/forcing.hpp"
#include "integrator/levels.hpp"
#include "integrator/newton.hpp"
#include "integrator/time_scheme.hpp"

namespace mudline {

/// Tolerances of one step.
struct StepTolerances {
  double residual = 1e-6;  // of the size of what acts in the step, before it cancels, per field
  double update = 1e-4;    // of the increment of the step, per field
  double linear = 1e-8;
  void parameters(Parameters& p);
};

struct StepRequest {
  double dt;
  TimeScheme scheme;
  /// Prescribed unknowns at the end of the step.
  std::function<void(double t_old, double t_end, const State& committed, Constraints&)> prescribe;
};

struct StepReport {
  bool converged = false;
  bool refused = false;       // by a term, though Newton's method converged
  int newton_iterations = 0;  // over all solves of the step
  int hardest_solve = 0;      // iterations of the solve that took most
  int augmentations = 0;      // solves after the first, for terms that augment
  int linear_iterations = 0;
  int factorisations = 0;
  std::string reason;
};

/// Wall-clock seconds of this rank spent so far.
struct StepTimes {
  double residual = 0, jacobian = 0, linear = 0;
};

/// What the coming steps are measured against, by field.
struct StepMeasures {
  /// Of the largest reference of the stage: late in a stage, when all rates have died out, what is left need not be
  /// followed for ever.
  static constexpr double floor_share = 1e-6;
  /// Largest size of what acted in a step of the stage so far, or of rounding: a millionth of it is the floor of the
  /// reference.
  std::vector<double> acting;
  std::vector<double> values;  // largest norm of the field so far, for its rounding
  std::vector<double> matrix;  // size of that of the last step of the stage which built one; 0: none yet

  explicit StepMeasures(int fields = 0) : acting(fields, 0), values(fields, 0), matrix(fields, 0) {}
  void begin_stage() {
    for (auto* sizes : {&acting, &matrix}) std::fill(sizes->begin(), sizes->end(), 0.0);
  }
  /// A step has converged: what acted in it, its rounding, and the relative tolerance; norms of its end; its matrix.
  void take(const std::vector<double>& acted, const std::vector<double>& rounding, double tolerance,
            const std::vector<double>& norms, const std::vector<double>& matrix_sizes) {
    for (std::size_t i = 0; i < acting.size(); ++i) {
      acting[i] = std::max({acting[i], acted[i], rounding[i] / (floor_share * tolerance)});
      values[i] = std::max(values[i], norms[i]);
      if (matrix_sizes[i] > 0) matrix[i] = matrix_sizes[i] * limit_matrix(i, matrix_sizes[i]);
    }
  }
  /// The share of a matrix of this size that counts: a millionfold of the last one at most (a step a thousand times
  /// shorter). At an iterate far from a solution the tangent of a law may be beyond all bounds, and so would the
  /// rounding that excuses a residual.
  double limit_matrix(std::size_t i, double size) const {
    return matrix[i] > 0 ? std::min(1.0, 1e6 * matrix[i] / size) : 1.0;
  }
};

/// One step as a transaction: begin (predictor, search) -> Newton on pure evaluations -> accept or nothing. Translates
/// between the unknown x (the value at n+1) and the levels that terms see.
class Stepper : public NonlinearProblem {
 public:
  /// Registers the terms' arrays and sparsity. `terms` must outlive the stepper; blocks supplies preconditioner data.
  Stepper(const Space& space, StateStore& store, std::vector<Term*> terms, LinearSolver& solver,
          std::function<BlockData(const StepView&)> block_data);

  /// Terms that act in the present stage, a subset of the constructor's; F_n is evaluated anew.
  void activate(const std::vector<Term*>& active);
  /// F_n of all active history terms at the committed state. Returns false if it cannot be evaluated.
  bool refresh_history();
  /// Residual of the committed state under static loads (no inertia, no flow), by overlap dof, summed over ranks.
  NodalView static_residual();
  /// What the active terms say of the last evaluation where it failed, "; ..." each; "" where nothing. Collective.
  std::string hints() const;
  /// Accelerations and first-order rates that satisfy the equations of motion at the committed state (start of a
  /// dynamic stage). Fields whose rate matrix is singular (incompressible constituents) keep the rate zero.
  bool initialise_rates(const StepRequest& request, double linear_tolerance);

  /// Whether the committed rates go on in a stage: the imbalance, relative to what acts, with which they end a step
  /// without inertia under its loads and motions, over that of staying where everything is. Small where something
  /// moves and they are its velocities; infinite where nothing moves, so that they are only what earlier loads left
  /// behind; 1 where it cannot be told. Collective.
  double misfit_of_rates(const StepRequest& request, const StepTolerances& tolerances);

  /// Lets the linear solver take up what LinearSolver::memory() gave in the run that is continued.
  void restore_solver(const std::vector<double>& memory);
  /// What restore_solver takes: the solver's memory and which Jacobian may serve on. The run goes on as a restarted one
  /// would.
  std::vector<double> solver_memory();

  /// First half of an attempt: predictor, prescribed unknowns, the terms' begin. Afterwards residual() and jacobian()
  /// may be called for any x. Returns the initial guess.
  Vector begin(const StepRequest& request, const StepTolerances& tolerances);

  /// Tries one step from the committed state, with full Newton steps and, where those do not converge, with damped
  /// ones; on success the trial state is complete. The committed state is untouched.
  StepReport attempt(const StepRequest& request, const StepTolerances& tolerances, const NewtonOptions& newton);

  /// The step that the last attempt found is not made: it leaves nothing behind that later ones are measured against.
  void reject() { measures_ = measures_before_; }

  // What the balances read after a successful attempt, before or after acceptance.
  const StepView& view() const { return view_; }
  const std::vector<Term*>& active() const { return active_; }
  const std::vector<Carried*>& carried() const { return carried_; }
  const std::vector<Reports*>& reports() const { return reports_; }
  /// Largest step that the active terms accept from the committed state, at most `dt` [s]. Collective.
  double step_limit(double dt) const;
  /// Alpha-level contribution of active term k (history terms: interpolated), this rank's part, by overlap dof.
  NodalView term_force(int k) const { return force_[k]; }
  /// Index of active term k's F_n among State::history_forces; -1 where it has none.
  int history_slot(int k) const;
  /// Sum over the terms at constrained dofs: the reaction, this rank's part; zero elsewhere.
  NodalView reaction() const { return reaction_; }
  const Constraints& constraints() const { return constraints_; }
  const Space& space() const { return space_; }
  StateStore& store() { return store_; }
  const Assembler& assembler() const { return assembler_; }
  const StepTimes& times() const { return times_; }
  /// Part of a checkpoint.
  StepMeasures& measures() { return measures_; }

  // NonlinearProblem
  RCP<const Map> map() const override { return space_.dofs()->owned(); }
  bool residual(const Vector& x, Vector& f) override;
  bool jacobian(const Vector& x) override;
  void apply_jacobian(const Vector& v, Vector& jv) override;
  bool solve(const Vector& f, Vector& dx) override;
  std::vector<double> residual_ratios(const Vector& f) override;
  std::vector<double> update_ratios(const Vector& dx, const Vector& x) override;
  bool at_rounding() const override;
  void observe(double worst) override;

 private:
  /// Where prescribed unknowns move, replaces the guess `x` (the others left behind, which folds or yields the elements
  /// in between when the motion is large) by the linear answer of the committed state to it; also where a term asks for
  /// that. False where it leaves x alone.
  bool predict(Vector& x);
  bool predict_linear(Vector& x, bool always);
  /// Moves the guess on with the committed rates; false, and x left alone, where nothing moves, where the terms cannot
  /// be evaluated there, or where it leaves more out of balance.
  bool extrapolate(Vector& x);
  /// x after the step at the committed rates, but for what is prescribed.
  Vector moved_on(const Vector& x) const;
  /// Whether the forces of the committed state, evaluated without any motion (the last evaluation), are those it was
  /// left with. A soil whose strength depends on the strain rate relaxes at rest: its answer there says nothing of a
  /// moving one.
  bool rests() const;
  /// Forgets the Jacobian at hand if the coming step has another step size, scheme or set of free unknowns.
  void check_chord();
  /// Whether the trial state was last evaluated at exactly x. Collective.
  bool stands_at(const Vector& x) const;
  /// attempt() with these options and no others.
  StepReport try_step(const StepRequest& request, const StepTolerances& tolerances, const NewtonOptions& newton);
  /// Solves from x, again where terms augment; on convergence the trial state stands at x, bit for bit.
  void solve_step(const NewtonOptions& newton, Vector& x, StepReport& report);
  /// Asks all active terms. Collective.
  Augmentation augment(int count);
  void prepare_view(const StepRequest& request, StepView::Kind kind);
  void set_sensitivities();
  void constrain(const StepRequest& request);
  /// Fills the level views and the trial's nodal part from x.
  void levels(const Vector& x);
  /// All levels are the committed state: no acceleration, no rates of first order; sensitivities to those alone.
  void levels_at_rest();
  /// The matrix of inertia and storage, by the terms that are no history.
  void add_rate_matrices();
  /// Prescribes the fields whose rate matrix has a row of zeros: it cannot be solved for. Whether there are any.
  bool hold_fields_without_rates();
  /// residual(); `renews`: whether a Jacobian at x is likely to be asked for next.
  bool evaluate(const Vector& x, bool renews, Vector& f);
  int evaluate_terms();
  /// Term::residual into `force`, behind `to`; one that throws, or gives what is not finite, counts as failed.
  int evaluate_term(Term& term, const NodalView& force, const ResidualView& to);
  /// Sizes of what acts and of rounding at the last evaluation.
  void measure();
  /// Rounding of the residual that the unknowns' own rounding makes through the matrix.
  void measure_rounding(const Vector& x);
  /// Residual allowed per field, whose reference is at least `least`.
  std::vector<double> allowed(const std::vector<double>& least) const;
  /// False, and failure_ says why, where a term throws on some rank. Collective.
  bool add_matrices();

  /// Rounding of a sum of contributions of size 1 that have some of their own.
  static constexpr double rounding_unit = 1e-14;

  const Space& space_;
  StateStore& store_;
  std::vector<Term*> terms_, active_;
  std::vector<int> history_slot_;        // by term: index of its F_n, -1
  std::vector<History*> history_;        // by slot
  std::vector<Unilateral*> unilateral_;  // of the active terms, as the other faces
  std::vector<Foresees*> foresees_;
  std::vector<Carried*> carried_;
  std::vector<Reports*> reports_;
  LinearSolver& solver_;
  std::function<BlockData(const StepView&)> block_data_;
  Assembler assembler_;
  StepView view_;
  TimeScheme scheme_;
  StepTolerances tolerances_;
  Constraints constraints_;
  Levels levels_;
  NodalView reaction_, total_, acting_, whole_;
  std::vector<NodalView> force_;
  // By field: what acts at the last evaluation, rounding of residual and matrix, size of the matrix, norms of the
  // residual of the first and of the last iterate that was measured, what is allowed for the latter, and norms of the
  // one observed before.
  std::vector<double> reference_, rounding_, matrix_rounding_, matrix_sizes_, first_norms_, norms_, limits_,
      observed_norms_;
  StepMeasures measures_, measures_before_;  // before: the last attempt that converged
  double coordinate_norm_ = 0;
  std::string failure_;
  int linear_iterations_ = 0, factorisations_ = 0;
  StepTimes times_;
  ChordControl chord_;
  Forcing forcing_;
  std::vector<double> enough_;  // of the coming linear solve, see LinearTolerance
  Vector evaluated_, balance_;  // where the trial state stands, and the residual there,
  bool stands_ = false;         // unless it has been moved since
};

}  // namespace mudline
