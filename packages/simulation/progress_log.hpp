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
  /// Steps to the end of the last stage, if all are easy and no stage ends before its duration is over.
  double steps_left(const RunView& run) const;

  double wall_start_ = 0, wall_last_ = 0;  // [s]
  double wall_step_ = 0;                   // [s] mean over the last steps
  int steps_ = 0;                          // since the program started
};

}  // namespace mudline
