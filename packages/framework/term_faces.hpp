// What a term may offer beside its core: faces, which it inherits. Whoever takes terms looks for their faces once.
#pragma once

#include <string>
#include <vector>

#include "framework/report.hpp"
#include "framework/term.hpp"

namespace mudline {

/// A term that is evaluated at n+1, where state variables live. The integrator keeps its forces as F_n and interpolates
/// them; those of other terms are evaluated at the alpha level.
class History {
 public:
  virtual ~History() = default;
  /// Adds what acts within the step only (a point that touches or leaves in it), at the alpha level; not part of F_n.
  /// After residual(), at the same x; jacobian() holds its derivative.
  virtual void correction(const StepView&, const ResidualView&) {}
  /// Whether its force may change at a standstill: strength that follows the strain rate.
  virtual bool may_relax() const { return false; }
};

/// A term whose matrix costs less where it is prepared for while the residual is evaluated: a soil law gives its
/// tangent beside its stress.
class Foresees {
 public:
  virtual ~Foresees() = default;
  /// Whether what residual() does from now on should be kept for a jacobian() at the same state.
  virtual void foresee_jacobian(bool likely) = 0;
  /// The next jacobian() is at another state than the last residual().
  virtual void forget_foreseen() = 0;
};

/// What a term wants once Newton's method has converged: nothing, another solve with what it holds changed
/// (multipliers), or to refuse the step for the reason given.
struct Augmentation {
  bool again = false;
  std::string refusal;
};

/// A term of inequalities: what touches presses, what is strained enough slides.
class Unilateral {
 public:
  virtual ~Unilateral() = default;
  /// True where the first guess of a step needs a linear answer to what moves in it (a body that drags the soil along):
  /// the integrator then solves once, between predicting(true) and predicting(false), before it iterates.
  virtual bool asks_for_prediction() const = 0;
  /// While predicting, a term may be more linear than it is: friction sticks.
  virtual void predicting(bool on) = 0;
  /// After Newton's method has converged, with the trial state at the solution: an outer iteration on what the term
  /// keeps in its part of the trial state and residual() only reads. `count`: solves of this kind that the step has
  /// had. The same answer on every rank. Collective.
  virtual Augmentation augment(const StepView&, int count) = 0;
  /// Largest step the term can accept [s] given the committed state (contact advance). Collective.
  virtual double step_limit(const State& committed, double dt) const = 0;
};

/// A term with state that must follow when the mesh is moved under the committed state (ALE).
class Transferred {
 public:
  virtual ~Transferred() = default;
  /// Carries the term's own arrays, those that are not point data of the soil, over to their new places.
  virtual void relocate(const ConstCoordinateView& x_old, State& committed) {}
  /// Takes over what an evaluation of the relocated state at rest wrote: stresses back on the yield surface, gaps.
  virtual void adopt(const State& evaluated, State& committed) = 0;
};

/// A term that says more than its forces.
class Reports {
 public:
  virtual ~Reports() = default;
  /// Scalars for the history file, already summed over ranks. Collective, after acceptance.
  virtual void histories(const StepView&, Report&) {}
  /// What a user should know when a step fails on account of this term; empty: nothing. Collective.
  virtual std::string hint(const StepView&) const { return ""; }
};

/// The face that an object offers; null where it does not.
template <class Face, class Object>
Face* face(Object& object) {
  return dynamic_cast<Face*>(&object);
}

/// The faces of those terms that offer it, in their order.
template <class Face>
std::vector<Face*> faces(const std::vector<Term*>& terms) {
  std::vector<Face*> found;
  for (Term* term : terms)
    if (Face* one = face<Face>(*term)) found.push_back(one);
  return found;
}

}  // namespace mudline
