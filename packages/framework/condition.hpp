#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/registry.hpp"
#include "framework/constraints.hpp"
#include "framework/report.hpp"
#include "framework/shared.hpp"
#include "framework/term.hpp"

namespace mudline {

/// The parts of a model that a condition may use when it is bound to it.
struct ConditionContext {
  const Space& space;
  const Shared& shared;  // objects that the physics offer
};

/// One named entry of the deck's "boundary conditions": prescribes unknowns, adds a load term, or both.
class Condition {
 public:
  virtual ~Condition() = default;
  /// Resolves sets and fields; throws InputError through `section`. Collective; every rank throws alike.
  virtual void bind(const ConditionContext& context, const Section& section) = 0;
  /// Prescribes unknowns at the end of a step from t_old (state `committed`) to t_end.
  virtual void prescribe(double t_old, double t_end, const State& committed, Constraints& constraints) const {}
  /// The load that the condition adds; null for purely prescribed ones.
  virtual Term* term() { return nullptr; }
  /// Whether its load may grow with the displacement and so support the soil, as a spring does. By default every
  /// condition with a load may.
  virtual bool may_hold() { return term() != nullptr; }
  /// The mesh set whose rigid motion it prevents, by prescribed displacements or by resistance; "": none.
  virtual std::string holds() const { return ""; }
  /// Whether the prescribed unknowns move: the reaction is then the resistance to that motion.
  virtual bool drives() const { return false; }
  /// Called when a stage begins in which the condition is newly active. `unbalanced`: residual of the committed state
  /// under what stays active, by overlap dof; zero where the stage prescribes the unknown. A condition that takes a
  /// force from it sets the entry to zero (owned dofs are enough), so that no other condition takes the same force.
  virtual void activate(const State& committed, const NodalView& unbalanced) {}
  /// Whether its force balances everything that acts when its stage begins, new loads too: it is then activated after
  /// the other conditions, with the residual of all other terms.
  virtual bool supports() const { return false; }
  /// Adds this rank's share of the reactions at the prescribed unknowns, "reaction/<name> x". The same names in every
  /// call; nodes that two conditions share count in both.
  virtual void reactions(const NodalView& reaction, Report& shares) const {}
  std::string name;
};

}  // namespace mudline
