#pragma once

#include <array>
#include <set>
#include <string>

#include "framework/state.hpp"

namespace mudline {

/// Sides of the boundary that bodies close to the pore water in a step: a condition prescribes no pore pressure on
/// them.
struct ClosedSides {
  bool possible = false;  // something may close sides in this step; the same on every rank
  // Side sets that something may seal in this step, and those through which water may flow into it, by a film or a
  // leak; the same on every rank.
  std::set<std::string> may_be_sealed, may_leak;
  std::set<std::array<int, 3>> sides;  // (block, element, side) of this rank
};

/// Interface of objects that may close sides: a sealing contact.
class ClosesSides {
 public:
  virtual ~ClosesSides() = default;
  /// Adds the sides that are closed in a step from the committed state.
  virtual void close(const State& committed, ClosedSides& closed) const = 0;
};

/// A condition that applies on open sides only.
class HoldsOnOpenSides {
 public:
  virtual ~HoldsOnOpenSides() = default;
  /// Sets the sides that are closed from now on; replaces the previous ones. Collective.
  virtual void set_closed(const ClosedSides& closed) = 0;
};

}  // namespace mudline
