#pragma once

#include "simulation/observer.hpp"

namespace mudline {

/// The highest excess pore pressure of each stage by magnitude, where and when, and its dissipation.
class ExcessResults : public Observer {
 public:
  void results(const RunView& run, ResultTable& to) override;
};

}  // namespace mudline
