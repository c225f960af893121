#pragma once

#include <vector>

#include "integrator/newton.hpp"
#include "integrator/step_system.hpp"

namespace mudline {

/// The unknowns after the system's step at `rates` (by overlap dof), from x; prescribed unknowns stay as in x.
Vector extrapolated(const StepSystem& system, const Vector& x, const NodalView& rates);

/// The largest norm of a field's residual, over the larger of two sizes of what acts on the field.
double largest_ratio(const std::vector<double>& norms, const std::vector<double>& scales,
                     const std::vector<double>& other_scales);

/// The unknowns from which Newton's method starts a step.
class FirstGuess {
 public:
  /// `system` must outlive it.
  explicit FirstGuess(StepSystem& system) : system_(system) {}
  /// Improves `x`, which StepSystem::begin() gave: by the predictor if the options say so, or else by a linear
  /// prediction. Returns how many linear systems it solved. Collective.
  int improve(Vector& x, const NewtonOptions& options);
  /// Whether the guess was more out of balance than the committed state, and an iteration from it halved that.
  bool on_trial() const { return on_trial_; }

 private:
  /// The rates of the last step, by overlap dof: the predictor; with inertia, and of bodies and multipliers, which have
  /// no mesh that moves, the committed rates.
  NodalView rates() const;
  /// Extrapolates the guess with the predictor. Returns false, with x unchanged, where nothing moves, where the terms
  /// cannot be evaluated there, or where the imbalance is larger and may not be halved by an iteration, or is not.
  /// may_try: whether it may, if there is no inertia.
  bool extrapolate(Vector& x, bool may_try);
  /// Takes one iteration of Newton's method from x, at which the residual was evaluated last; `f`: it, `before`: its
  /// norms by field. Returns whether that leaves less than half of the imbalance; if not, x and f mean nothing any
  /// more.
  bool iterate(Vector& x, Vector& f, const std::vector<double>& before);
  /// Linear prediction: where prescribed unknowns move or a term asks for it, replaces the guess `x` by the linear
  /// response of the committed state. Otherwise all other unknowns would stay behind, and a large motion would fold or
  /// yield the elements in between.
  void predict(Vector& x);
  void predict_linear(Vector& x, bool always);
  /// Whether the forces of the committed state at rest (the last evaluation) equal its stored F_n. Soil whose strength
  /// depends on the strain rate relaxes at rest; its response there does not apply to a motion.
  bool rests() const;

  StepSystem& system_;
  int solved_ = 0;  // linear systems
  bool on_trial_ = false;
};

}  // namespace mudline
