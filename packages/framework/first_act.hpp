#pragma once

#include "framework/state.hpp"

namespace mudline {

/// A term that records something of the state in which it first acts: gaps, or a stress that is already there.
class FirstActs {
 public:
  virtual ~FirstActs() = default;
  /// Called at the start of every stage in which the term acts. It writes the term's arrays where it has not acted
  /// before. Collective.
  virtual void first_act(State& committed) = 0;
};

}  // namespace mudline
