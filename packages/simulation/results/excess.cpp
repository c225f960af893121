#include "simulation/results/excess.hpp"

#include <cmath>

#include "simulation/excess_pressure.hpp"
#include "simulation/model.hpp"
#include "simulation/results/dissipation.hpp"

namespace mudline {

namespace {

constexpr const char* soil_name = "soil";
const std::string excess_name = "excess pore pressure";

void set_place(const RunView& run, const std::string& stage, const ExcessPressure::AtPlace& highest, ResultTable& to) {
  for (int i = 0; i < run.model.mesh().dimension(); ++i)
    to.set(stage, soil_name, "highest " + excess_name + " at " + axis_names[i], "m", highest.place[i]);
  const double since = stage.empty() ? 0.0 : run.stage_start;
  to.set(stage, soil_name, "highest " + excess_name + " after", "s", run.state.time - since);
}

/// Whether a pressure is of a larger magnitude than the highest so far, of a stage or ("") of the run.
bool is_higher(const ExcessPressure::AtPlace& now, const std::string& stage, const ResultTable& than) {
  const Result* const before = than.find(stage, soil_name, "highest " + excess_name);
  return before == nullptr || std::abs(now.pressure) > std::abs(before->value);
}

}  // namespace

void ExcessResults::results(const RunView& run, ResultTable& to) {
  if (!run.model.soil() || run.model.soil()->pressure < 0) return;
  const std::string& stage = run.stage.name;
  const ExcessPressure::AtPlace now = run.pressure.highest();
  const bool higher = is_higher(now, stage, to);
  const double highest = higher ? now.pressure : to.find(stage, soil_name, "highest " + excess_name)->value;
  follow_dissipation(run, soil_name, excess_name, now.pressure, highest, to);
  if (higher) set_place(run, stage, now, to);
  if (!is_higher(now, "", to)) return;
  to.set("", soil_name, "highest " + excess_name, "Pa", now.pressure);
  set_place(run, "", now, to);
}

}  // namespace mudline
