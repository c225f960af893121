// Optional interfaces ("faces") of a term, which it inherits. Users of terms look them up once.
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
  /// Adds forces that act within the step only (of a point that closes or opens in it), at the alpha level; they are
  /// not part of F_n. Called after residual() at the same x; jacobian() includes the derivative.
  virtual void correction(const StepView&, const ResidualView&) {}
  /// Whether its force may change without motion, as strength that depends on the strain rate does.
  virtual bool may_relax() const { return false; }
};

/// A history term that completes the trial state once the step has converged: where state is better known from the
/// whole step than within an iteration.
class Completes {
 public:
  virtual ~Completes() = default;
  /// Changes the trial state and, where it does, writes the forces of the changed state to F_n. Returns the number of
  /// points on this rank where that failed. Collective.
  virtual int complete(const StepView&, const NodalView& forces) = 0;
};

/// A term whose matrix costs less if the residual prepares for it: a soil law can return its tangent together with its
/// stress.
class Foresees {
 public:
  virtual ~Foresees() = default;
  /// Whether residual() should from now on keep its results for a jacobian() at the same state.
  virtual void foresee_jacobian(bool likely) = 0;
  /// The next jacobian() is at another state than the last residual().
  virtual void forget_foreseen() = 0;
};

/// Answer of a term once Newton's method has converged: nothing, another solve with changed multipliers, or refusal of
/// the step for the reason given.
struct Augmentation {
  bool again = false;
  std::string refusal;
};

/// A term with inequality constraints, such as unilateral contact with friction.
class Unilateral {
 public:
  virtual ~Unilateral() = default;
  /// True where the first guess of a step needs the linear response to the motion in it (a body that drags the soil
  /// along): the integrator then solves once, between predicting(true) and predicting(false), before it iterates.
  virtual bool asks_for_prediction() const = 0;
  /// During the prediction a term may be linearised further: all friction points stick.
  virtual void predicting(bool on) = 0;
  /// Outer iteration after Newton's method has converged, with the trial state at the solution: changes data in the
  /// term's part of the trial state that residual() only reads. `count`: number of augmented solves that the step has
  /// had. The answer is the same on every rank. Collective.
  virtual Augmentation augment(const StepView&, int count) = 0;
  /// Largest step [s] that the term accepts from the committed state (a limit on contact motion); dt: the intended step
  /// [s]. Collective.
  virtual double step_limit(const State& committed, double dt) const = 0;
};

/// A term that reports more than its forces.
class Reports {
 public:
  virtual ~Reports() = default;
  /// Scalars for the history file, already summed over ranks. Collective, after acceptance.
  virtual void histories(const StepView&, Report&) {}
  /// Message to the user when a step fails because of this term; empty: none. Collective.
  virtual std::string hint(const StepView&) const { return ""; }
};

/// The object as this face; null if it does not have it.
template <class Face, class Object>
Face* face(Object& object) {
  return dynamic_cast<Face*>(&object);
}

/// The terms that have this face, in their order.
template <class Face>
std::vector<Face*> faces(const std::vector<Term*>& terms) {
  std::vector<Face*> found;
  for (Term* term : terms)
    if (Face* one = face<Face>(*term)) found.push_back(one);
  return found;
}

}  // namespace mudline
