#pragma once

#include <array>
#include <set>

#include "framework/state.hpp"

namespace mudline {

/// Sides of the boundary that bodies close to the pore water in a step: a condition prescribes no pore pressure on
/// them.
struct ClosedSides {
  bool possible = false;               // on every rank alike: something may close sides in this step
  std::set<std::array<int, 3>> sides;  // block, element, side: those of this rank
};

/// What may close sides: a contact that seals.
class ClosesSides {
 public:
  virtual ~ClosesSides() = default;
  /// Adds the sides that it closes in the step that starts from the committed state.
  virtual void close(const State& committed, ClosedSides& closed) const = 0;
};

/// A condition that holds on open sides only.
class HoldsOnOpenSides {
 public:
  virtual ~HoldsOnOpenSides() = default;
  /// Sides that are closed from now on, in place of those before. Collective.
  virtual void set_closed(const ClosedSides& closed) = 0;
};

}  // namespace mudline
