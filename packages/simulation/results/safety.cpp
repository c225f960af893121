#include "simulation/results/safety.hpp"

#include <algorithm>

#include "simulation/model.hpp"
#include "simulation/output/history_file.hpp"

namespace mudline {

namespace {

const std::string reduction_name = "strength reduction";

/// The factor of the committed state.
double strength_factor(const RunView& run) {
  return run.model.soil() ? run.model.soil()->strength_factor(run.state.time - run.stage_start) : 1.0;
}

}  // namespace

void SafetyResults::columns(const RunView& run, std::vector<HistoryValue>& row) {
  const auto& stages = run.model.stages();
  if (std::any_of(stages.begin(), stages.end(), [](const auto& stage) { return stage->strength_reduction.acts(); }))
    row.push_back({reduction_name + "/factor", "-", strength_factor(run)});
}

void SafetyResults::end_stage(const RunView& run) {
  const std::string& stage = run.stage.name;
  // a run that goes on from a stage which is over has its factors already
  if (!run.stage.strength_reduction.acts() || table_.find(stage, reduction_name, factor_of_safety)) return;
  const bool lost = run.lost_factor > 0;
  table_.set(stage, reduction_name, lost ? factor_of_safety : factor_with_equilibrium, "-", strength_factor(run));
  if (!lost) return;
  table_.set(stage, reduction_name, factor_without_equilibrium, "-", run.lost_factor);
}

}  // namespace mudline
