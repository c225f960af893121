#pragma once

#include "framework/state.hpp"

namespace mudline {

/// A term that takes something from the state in which it first acts: gaps, a stress that stands there already.
class FirstActs {
 public:
  virtual ~FirstActs() = default;
  /// At the start of every stage in which the term acts; it writes its own arrays where it has not acted before.
  /// Collective.
  virtual void first_act(State& committed) = 0;
};

}  // namespace mudline
