#pragma once

#include "simulation/model.hpp"

namespace mudline {

/// The rates (velocities and accelerations) with which a stage starts. A stage without inertia leaves behind the
/// increments of its last step over its duration. These are true velocities where a motion was prescribed, but not
/// where a load was applied.
class InitialRates {
 public:
  /// `before`: the stage before; null: none.
  InitialRates(Model& model, const Stage& stage, const Stage* before) : model_(model), stage_(stage), before_(before) {}
  /// Writes the rates to the committed state. `first`: the first step of the stage. Collective.
  void give(const StepRequest& first) const;

 private:
  /// Judges the velocities that a stage without inertia left, and clears those that nothing in the new stage keeps up.
  /// Bodies with prescribed motion keep theirs.
  void judge(const StepRequest& first) const;
  void clear() const;
  /// Largest component of the mesh's velocities [m/s], over all ranks.
  double largest_velocity() const;

  Model& model_;
  const Stage& stage_;
  const Stage* before_;
};

}  // namespace mudline
