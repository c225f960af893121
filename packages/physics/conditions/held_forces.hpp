#pragma once

#include <string>
#include <vector>

#include "framework/space.hpp"
#include "framework/state.hpp"
#include "framework/term.hpp"

namespace mudline {

/// Constant forces at the nodes of a set, which hold what they found there. The state keeps them.
class HeldForces {
 public:
  /// Declares the state array `name`, of (node of the set, axis) [N], and its rule of transfer. `field`: number of the
  /// displacement.
  void declare(StateStore& store, const std::string& name, const Space& space, int field, const std::string& set,
               Transfer rule);
  /// Takes the forces that balance `unbalanced`, a residual by overlap dof, and sets it to zero at the nodes.
  void take(const NodalView& unbalanced);
  /// Adds the forces of the step's start to a residual.
  void add(const StepView& view, const ResidualView& f) const;

 private:
  int dof_of(std::size_t row, int axis) const { return space_->node_dof(field_)(nodes_[row]) + axis; }
  const Space* space_ = nullptr;
  StateStore* store_ = nullptr;
  int field_ = -1;          // the displacement
  int array_ = -1;          // of the state
  std::vector<int> nodes_;  // by row: owned nodes of the set
};

}  // namespace mudline
