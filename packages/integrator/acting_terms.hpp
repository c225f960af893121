#pragma once

#include <string>
#include <vector>

#include "algebra/assembler.hpp"
#include "framework/term_faces.hpp"

namespace mudline {

/// The terms of a model: those that act in the present stage, the sum of their forces and the sum of their matrices.
/// Forces are by overlap dof and this rank's part.
class ActingTerms {
 public:
  /// Registers the arrays and the sparsity of all terms. `space`, `store` and the terms must outlive it.
  ActingTerms(const Space& space, StateStore& store, std::vector<Term*> terms);
  /// Sets the terms that act, a subset of the constructor's.
  void activate(const std::vector<Term*>& active);

  /// Begins a step, or another evaluation, for all of them.
  void begin(const StepView& view);
  /// Evaluates the forces and adds them up; forces of history terms are interpolated, with the weight `start_weight` of
  /// those at the start of the step. Returns the number of points on this rank where a term failed.
  int evaluate(const StepView& view, double start_weight);
  /// Moves the forces at prescribed unknowns from the sum to the reactions.
  void split_reactions(const StepView& view);
  /// Evaluates F_n of the history terms at the committed state. Returns the number of points on this rank that failed.
  int refresh_history(const StepView& view);
  /// Completes the trial state (see Completes). Returns the number of points on this rank that failed. Collective.
  int complete(const StepView& view);
  /// The next jacobian of a term that prepares for it is likely, or not.
  void foresee_jacobian(bool likely);
  /// The next Jacobian is at another state than the last evaluation.
  void forget_foreseen();

  /// Assembles the matrices of all acting terms. Returns "", or why a term threw on some rank. Collective.
  std::string add_matrices(const StepView& view);
  /// Assembles the matrices of those that are no history terms, at the start of a step: inertia and storage.
  void add_rate_matrices(const StepView& view);
  RCP<const CrsMatrix> matrix() const { return assembler_.matrix(); }

  const std::vector<Term*>& active() const { return active_; }
  const std::vector<Reports*>& reports() const { return reports_; }
  const std::vector<Unilateral*>& unilateral() const { return unilateral_; }
  /// Index of the F_n of active term k in State::history_forces; -1 where it has none.
  int history_slot(int k) const;
  /// Force of active term k at the alpha level.
  NodalView force(int k) const { return force_[k]; }
  /// Sum of the forces, without those at prescribed unknowns once the reactions were split off.
  const NodalView& total() const { return total_; }
  /// Sum of the forces at prescribed unknowns, and the flow through open ones; zero elsewhere.
  const NodalView& reaction() const { return reaction_; }
  /// Sizes of what acted in the last evaluation, and of all contributions, before they cancel.
  const NodalView& acting() const { return acting_; }
  const NodalView& whole() const { return whole_; }
  /// Why a term failed in the last evaluation on this rank; "" if none did.
  const std::string& failure() const { return failure_; }
  /// Messages of the terms about a step that failed, "; ..." each; "" if there are none. Collective.
  std::string hints(const StepView& view) const;
  /// Largest step that the terms accept from the committed state, at most `dt` [s]. Collective.
  double step_limit(double dt) const;

 private:
  /// Evaluates Term::residual into `force` through `to`; a term that throws or returns a non-finite value counts as
  /// failed.
  int evaluate_term(Term& term, const StepView& view, const NodalView& force, const ResidualView& to);

  const Space& space_;
  StateStore& store_;
  std::vector<Term*> terms_, active_;
  std::vector<int> history_slot_;        // by term: index of its F_n, -1
  std::vector<History*> history_;        // by slot
  std::vector<Unilateral*> unilateral_;  // faces of the active terms, like the next two
  std::vector<Foresees*> foresees_;
  std::vector<Reports*> reports_;
  Assembler assembler_;
  std::vector<NodalView> force_;
  NodalView reaction_, total_, acting_, whole_, passing_;
  std::string failure_;
};

}  // namespace mudline
