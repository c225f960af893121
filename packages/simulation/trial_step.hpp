#pragma once

#include <string>

#include "simulation/model.hpp"

namespace mudline {

/// What the first step of a stage takes, tried on the state at the start of a run.
struct TrialStep {
  std::string stage;
  int iterations = 0;         // of Newton's method, over all solves; 0: the step could not be begun
  double seconds = 0;         // [s] wall time of the step, the slowest rank's
  std::string failure;        // why it did not converge; "": it did
  double memory = 0;          // [bytes] largest that the program has taken so far, summed over ranks
  double largest_memory = 0;  // [bytes] that of the rank that took most
};

/// Tries the first step of the first stage that takes time, without accepting it, twice where it converges; geostatic
/// stages before it are passed over. `stage` "" in the result: there is no such stage. The model is of no use for a run
/// afterwards. Collective.
TrialStep try_first_step(Model& model);

/// Number of steps that the stages of a model take if none is cut; a geostatic stage takes one.
double expected_steps(const Model& model);

}  // namespace mudline
