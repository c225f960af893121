#pragma once

#include <string>

#include "simulation/history_output.hpp"
#include "simulation/stage_end.hpp"

namespace mudline {

/// Looks whether something ends the present stage of a run before its duration is over.
class StageEnds {
 public:
  explicit StageEnds(HistoryOutput& history) : history_(history) {}
  /// What the stage's ends watch as it begins is what they remember. Collective.
  void begin_stage(const RunView& run, StageEndMemory& memory) const;
  /// Which end of the stage is reached after a step, and by what; "": none. The ends of all stages are checked against
  /// the columns of the history at the first step of each model. InputError. Collective.
  std::string reached(const RunView& run, StageEndMemory& memory);

 private:
  HistoryOutput& history_;
  const Model* checked_ = nullptr;
};

}  // namespace mudline
