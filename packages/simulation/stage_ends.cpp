#include "simulation/stage_ends.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/model.hpp"

namespace mudline {

namespace {

bool needs_columns(const Stage& stage) {
  return std::any_of(stage.ends.begin(), stage.ends.end(), [](const auto& end) { return end->needs_columns(); });
}

}  // namespace

void StageEnds::begin_stage(const RunView& run, StageEndMemory& memory) const {
  memory.clear();
  for (const auto& end : run.stage.ends) memory[end->name] = std::abs(end->measure(run, {}));
}

std::string StageEnds::reached(const RunView& run, StageEndMemory& memory) {
  if (checked_ != &run.model)
    for (const auto& stage : run.model.stages())
      if (needs_columns(*stage))
        for (const auto& end : stage->ends) end->check(history_.row(run));
  checked_ = &run.model;
  const std::vector<HistoryValue> none, &row = needs_columns(run.stage) ? history_.row(run) : none;
  for (const auto& end : run.stage.ends) {
    const double now = end->measure(run, row);
    double& largest = memory[end->name];
    largest = std::max(largest, std::abs(now));
    if (end->reached(now, largest)) return "'" + end->name + "': " + end->told_end(now, largest);
  }
  return "";
}

}  // namespace mudline
