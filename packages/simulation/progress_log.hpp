#pragma once

#include "simulation/observer.hpp"

namespace mudline {

/// Prints a line per step, and what the run took at its end.
class ProgressLog : public Observer {
 public:
  void begin_run(const RunView& run) override;
  void step(const RunView& run) override;
  void end_run(const RunView& run, RunEnd end) override;

 private:
  double wall_start_ = 0;  // [s]
  int steps_ = 0;          // since the program started
};

}  // namespace mudline
