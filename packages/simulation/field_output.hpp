#pragma once

#include <memory>
#include <optional>
#include <string>

#include "simulation/model.hpp"
#include "simulation/observer.hpp"
#include "simulation/old_results.hpp"
#include "simulation/output/field_file.hpp"
#include "simulation/output_settings.hpp"

namespace mudline {

/// Writes the fields of the committed state: at the start, in the intervals that the deck wants, at the ends of stages
/// and where a run fails.
class FieldOutput : public Observer {
 public:
  /// `observers`: asked for their cell fields.
  FieldOutput(const OutputSettings& settings, Origin origin, const Observers& observers)
      : settings_(settings), origin_(std::move(origin)), observers_(observers) {}
  /// Goes on with files that are there; to be called before the run begins.
  void go_on(FieldRestart restart) { restart_ = std::move(restart); }
  /// Number of steps in the files so far, and their fingerprints, for a checkpoint.
  int num_steps() const { return file_->num_steps(); }
  const FieldMarks& marks() const { return file_->marks(); }

  /// Opens the files.
  void begin_run(const RunView& run) override;
  void begin_stage(const RunView& run) override;
  void step(const RunView& run) override;
  /// Writes the last state of a stage that ended because the step after it found no equilibrium.
  void end_stage(const RunView& run) override;
  void remeshed(const RunView& run) override;
  /// Writes the last state of a run that fails. Throws RunError where files are gone at the end of one that is done.
  void end_run(const RunView& run, RunEnd end) override;

 private:
  void open(const Model& model);
  void write(const RunView& run, const std::string& stage);
  /// The first multiple of the field interval, from the stage's start, after the present time [s].
  double time_after(const RunView& run) const;

  const OutputSettings settings_;
  const Origin origin_;
  const Observers& observers_;
  std::optional<FieldRestart> restart_;
  std::unique_ptr<FieldFile> file_;
  double next_time_ = 0;   // [s] at which fields are due
  int written_step_ = -1;  // of the last fields
};

}  // namespace mudline
