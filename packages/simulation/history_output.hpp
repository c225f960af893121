#pragma once

#include <memory>
#include <optional>

#include "simulation/model.hpp"
#include "simulation/observer.hpp"
#include "simulation/output/history_file.hpp"
#include "simulation/output_settings.hpp"
#include "simulation/probes.hpp"

namespace mudline {

class ErrorOutput;

/// Writes the history: a row per accepted step, or every so many, and one where a run ends or is interrupted.
class HistoryOutput : public Observer {
 public:
  /// `observers`: asked for their columns. `error`: null where no estimate is asked for.
  HistoryOutput(const OutputSettings& settings, const Observers& observers, const ErrorOutput* error)
      : settings_(settings), observers_(observers), error_(error) {}
  /// Goes on with a file that is there; to be called before the run begins.
  void go_on(const HistoryRestart& restart) { restart_ = restart; }
  /// Length of the file so far, for a checkpoint.
  const HistoryMark& mark() const { return file_->mark(); }
  /// The columns after the last step, but its time; they are worked out once. Collective.
  const std::vector<HistoryValue>& row(const RunView& run);

  /// Opens the file.
  void begin_run(const RunView& run) override;
  void step(const RunView& run) override;
  void remeshed(const RunView& run) override;
  /// Writes the row of the last step where a stage ends after it.
  void end_stage(const RunView& run) override { write_due_row(run); }
  /// The row of a run that is interrupted follows its checkpoint: a restart drops it. Throws RunError where the file is
  /// gone at the end of a run that is done.
  void end_run(const RunView& run, RunEnd end) override;

 private:
  /// Writes the last step's row where that has not been written yet.
  void write_due_row(const RunView& run);
  std::vector<HistoryValue> columns_after(const RunView& run) const;

  const OutputSettings settings_;
  const Observers& observers_;
  const ErrorOutput* error_;
  std::optional<HistoryRestart> restart_;
  std::unique_ptr<HistoryFile> file_;
  std::unique_ptr<Probes> probes_;
  bool due_ = false;  // the last step's row is not written yet
  std::vector<HistoryValue> row_;
  int row_step_ = -1;  // number of the step that row_ belongs to
};

}  // namespace mudline
