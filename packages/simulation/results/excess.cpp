#include "simulation/results/excess.hpp"

#include <cmath>

#include "integrator/overlap.hpp"
#include "simulation/excess_pressure.hpp"
#include "simulation/model.hpp"
#include "simulation/output/collective.hpp"
#include "simulation/results/dissipation.hpp"

namespace mudline {

namespace {

/// An excess pore pressure [Pa] and its place.
struct Highest {
  double pressure = 0;
  Point place{};
};

/// The one of the largest magnitude on all ranks. Collective.
Highest highest_of(const RunView& run) {
  const NodalView excess = run.pressure.values();
  const Mesh& mesh = run.model.mesh();
  const auto& dofs = run.model.space().node_dof(run.model.soil()->pressure);
  Highest own;
  for (int node = 0; node < mesh.num_nodes(); ++node)
    if (const int dof = dofs(node); dof >= 0 && std::abs(excess(dof)) > std::abs(own.pressure))
      own = {excess(dof), place_of(run.state.coordinates, node)};
  const Comm& comm = *mesh.comm();
  const double largest = max_over_ranks(comm, std::abs(own.pressure));
  const bool here = std::abs(own.pressure) == largest;
  // the first rank tells where several have it
  const int first = static_cast<int>(min_over_ranks(comm, here ? comm.getRank() : comm.getSize()));
  if (comm.getRank() != first) own = {};
  const std::vector<double> sum =
      sum_over_ranks(comm, std::vector<double>{own.pressure, own.place[0], own.place[1], own.place[2]});
  return {sum[0], {sum[1], sum[2], sum[3]}};
}

constexpr const char* soil_name = "soil";
const std::string excess_name = "excess pore pressure";

void set_place(const RunView& run, const std::string& stage, const Highest& highest, ResultTable& to) {
  for (int i = 0; i < run.model.mesh().dimension(); ++i)
    to.set(stage, soil_name, "highest " + excess_name + " at " + axis_names[i], "m", highest.place[i]);
  const double since = stage.empty() ? 0.0 : run.stage_start;
  to.set(stage, soil_name, "highest " + excess_name + " after", "s", run.state.time - since);
}

/// Whether a pressure is of a larger magnitude than the highest so far, of a stage or ("") of the run.
bool is_higher(const Highest& now, const std::string& stage, const ResultTable& than) {
  const Result* const before = than.find(stage, soil_name, "highest " + excess_name);
  return before == nullptr || std::abs(now.pressure) > std::abs(before->value);
}

}  // namespace

void ExcessResults::results(const RunView& run, ResultTable& to) {
  if (!run.model.soil() || run.model.soil()->pressure < 0) return;
  const std::string& stage = run.stage.name;
  const Highest now = highest_of(run);
  const bool higher = is_higher(now, stage, to);
  const double highest = higher ? now.pressure : to.find(stage, soil_name, "highest " + excess_name)->value;
  follow_dissipation(run, soil_name, excess_name, now.pressure, highest, to);
  if (higher) set_place(run, stage, now, to);
  if (!is_higher(now, "", to)) return;
  to.set("", soil_name, "highest " + excess_name, "Pa", now.pressure);
  set_place(run, "", now, to);
}

}  // namespace mudline
