#pragma once

#include "simulation/results/result_table.hpp"
#include "simulation/stage_end.hpp"

namespace mudline {

/// Where a run stands; together with the committed state it makes a restart exact.
struct Progress {
  int stage = 0;                                     // index
  int step_in_stage = 0;                             // accepted steps
  int step = 0;                                      // of the run, the geostatic ones among them
  double stage_start = 0, next_dt = 0, last_dt = 0;  // [s]
  bool stage_open = false;                           // the stage has begun
  bool stage_over = false;                           // one of its ends is reached
  StageEndMemory ends;                               // of the present stage
  ResultTable results;                               // so far
  int remesh_tried = 0;                              // step after which remeshing was last tried
};

}  // namespace mudline
