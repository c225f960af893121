#pragma once

#include "simulation/history_output.hpp"
#include "simulation/observer.hpp"
#include "simulation/results/result_table.hpp"

namespace mudline {

/// Collects the results of a run from its observers after each step. At the end of the run it writes them to
/// "<stem>.results.csv" and, where the run is done, tells them in lines.
class Results : public Observer {
 public:
  /// `table`: kept with the run's progress, so that a restart goes on with it. `history`: gives the balances.
  Results(ResultTable& table, const Observers& observers, HistoryOutput& history)
      : table_(table), observers_(observers), history_(history) {}
  void step(const RunView& run) override;
  void end_stage(const RunView& run) override;
  void end_run(const RunView& run, RunEnd end) override;

 private:
  /// The resistance over that before a rest [-], where this stage follows one.
  void add_set_up(const RunView& run);
  void add_accuracy(const RunView& run);

  ResultTable& table_;
  const Observers& observers_;
  HistoryOutput& history_;
};

}  // namespace mudline
