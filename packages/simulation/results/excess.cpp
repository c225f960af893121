#include "simulation/results/excess.hpp"

#include <cmath>

#include "simulation/excess_pressure.hpp"
#include "simulation/model.hpp"
#include "simulation/results/dissipation.hpp"

namespace mudline {

namespace {

constexpr const char* soil_name = "soil";
const std::string excess_name = "excess pore pressure", highest_name = "highest " + excess_name;

/// Where and when it is the highest, of a stage or ("") of the run.
void set_place(const RunView& run, const std::string& stage, const Point& place, ResultTable& to) {
  for (int i = 0; i < run.model.mesh().dimension(); ++i)
    to.set(stage, soil_name, highest_name + " at " + axis_names[i], "m", place[i]);
  const double since = stage.empty() ? 0.0 : run.stage_start;
  to.set(stage, soil_name, highest_name + " after", "s", run.state.time - since);
}

}  // namespace

void ExcessResults::results(const RunView& run, ResultTable& to) {
  if (!run.model.soil() || run.model.soil()->pressure < 0) return;
  const ExcessPressure::AtPlace now = run.pressure.highest();
  Dissipation of_soil(run.stage.name, soil_name, excess_name, to);
  if (!of_soil.follow(run.state.time - run.stage_start, run.dt, now.pressure)) return;
  set_place(run, run.stage.name, now.place, to);
  const Result* const of_run = to.find("", soil_name, highest_name);
  if (of_run != nullptr && std::abs(now.pressure) <= std::abs(of_run->value)) return;
  to.set("", soil_name, highest_name, "Pa", now.pressure);
  set_place(run, "", now.place, to);
}

}  // namespace mudline
