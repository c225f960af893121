#pragma once

#include "simulation/model.hpp"

namespace mudline {

/// The rates with which a stage starts. Those that a stage without inertia leaves behind are the changes of its last
/// step per time: velocities where something moves, but nothing of the kind where a load was put on.
class InitialRates {
 public:
  /// `before`: the stage before; null: none.
  InitialRates(Model& model, const Stage& stage, const Stage* before) : model_(model), stage_(stage), before_(before) {}
  /// Writes them to the committed state. `first`: the first step of the stage. Collective.
  void give(const StepRequest& first) const;

 private:
  /// Judges what a stage without inertia left, and clears what does not go on. Bodies that were moved go on moving.
  void judge(const StepRequest& first) const;
  void clear() const;
  /// Of the mesh [m/s].
  double largest_velocity() const;

  Model& model_;
  const Stage& stage_;
  const Stage* before_;
};

}  // namespace mudline
