#include "simulation/results/results.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/log.hpp"
#include "core/run_error.hpp"
#include "simulation/model.hpp"
#include "simulation/output/atomic_file.hpp"
#include "simulation/output/collective.hpp"
#include "simulation/output/history_file.hpp"
#include "simulation/results/dissipation.hpp"
#include "simulation/results/result_lines.hpp"

namespace mudline {

namespace {

constexpr std::size_t most_lines = 10;

std::optional<double> column(const std::vector<HistoryValue>& row, const std::string& name) {
  const HistoryValue* const found = find_value(row, name);
  return found == nullptr ? std::nullopt : std::optional(found->value);
}

/// The error of the energy balance over the largest of its parts [-] or, where no part is larger than the error, in J;
/// nothing where there is no such balance.
std::optional<HistoryValue> energy_error(const std::vector<HistoryValue>& row) {
  const std::string energy = "balance/energy/", error = energy + "error";
  double largest = 0;
  for (const HistoryValue& value : row)
    if (value.name.compare(0, energy.size(), energy) == 0 && value.name != error)
      largest = std::max(largest, std::abs(value.value));
  const std::optional<double> amount = column(row, error);
  if (!amount || largest == 0) return std::nullopt;
  constexpr double whole = 0.999;  // of the largest part: there is no work to compare with
  const bool alone = std::abs(*amount) > whole * largest;
  return HistoryValue{error, alone ? "J" : "-", alone ? *amount : *amount / largest};
}

}  // namespace

void Results::step(const RunView& run) {
  if (run.stage.type == Stage::Type::geostatic) return;
  table_.set(run.stage.name, "stage", "duration", "s", run.state.time - run.stage_start);
  for (const auto& observer : observers_) call(*observer, run.model, [&](Observer& one) { one.results(run, table_); });
}

void Results::end_stage(const RunView& run) {
  if (run.stage.type == Stage::Type::geostatic) return;
  add_set_up(run);
  add_accuracy(run);
}

void Results::add_set_up(const RunView& run) {
  const auto& stages = run.model.stages();
  const std::size_t present = run.model.index_of(run.stage);
  if (present < 2) return;
  const std::string &before = stages[present - 2]->name, &rest = stages[present - 1]->name, &now = run.stage.name;
  for (const auto& [name, body] : run.model.bodies()) {
    // what a free body finds at its end is its weight
    if (body->unknowns().count > 0 || !rested(table_, rest, name)) continue;
    const Result* const driven = table_.find(before, name, "resistance");
    const Result* const highest = table_.find(now, name, "highest resistance");
    if (highest != nullptr && driven != nullptr && highest->value > 0 && driven->value > 0)
      table_.set(now, name, "set-up ratio", "-", highest->value / driven->value);
  }
}

void Results::add_accuracy(const RunView& run) {
  const std::vector<HistoryValue>& row = history_.row(run);
  const auto add = [&](const char* of, const char* quantity, std::optional<double> value) {
    if (value) table_.set("", of, quantity, "-", *value);
  };
  if (const auto energy = energy_error(row)) table_.set("", "balance", "error of energy", energy->unit, energy->value);
  add("balance", "error of water", column(row, "balance/water/error"));
  add("mesh motion", "change of solid", column(row, "mesh motion/change of solid"));
  add("mesh motion", "change of water", column(row, "mesh motion/change of water"));
  add("discretisation", "error of stress", column(row, "mesh/stress error"));
  add("discretisation", "error of flow", column(row, "mesh/flow error"));
}

void Results::end_run(const RunView& run, RunEnd end) {
  const Comm& comm = *run.model.mesh().comm();
  if (table_.all().empty()) return;
  const std::string path = run.stem + ".results.csv";
  const std::string error = agreed_message(raw_communicator(comm),
                                           comm.getRank() == 0 ? write_atomically(path, table_.csv()) : std::string());
  if (!error.empty()) throw RunError(error);
  if (end != RunEnd::done) return;
  log::info("results, all of them in " + path + ":");
  for (const std::string& line : result_lines(table_, most_lines)) log::info("  " + line);
}

}  // namespace mudline
