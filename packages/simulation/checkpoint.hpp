#pragma once

#include <memory>
#include <string>
#include <utility>

#include "simulation/excess_pressure.hpp"
#include "simulation/field_output.hpp"
#include "simulation/history_output.hpp"
#include "simulation/model.hpp"
#include "simulation/old_results.hpp"
#include "simulation/output/checkpoint_file.hpp"
#include "simulation/progress.hpp"

namespace mudline {

/// The checkpoint of a run, "<stem>.restart": the whole committed state, the run's progress, its deck, and how far its
/// history and fields reach. It is no observer: at a step it is written after the files of the observers, at the end of
/// a run before them, so that a restart drops what they write there.
class Checkpoint {
 public:
  /// What goes on from it: the same run, another one that starts at the end of one of its stages, or a model that only
  /// takes its state.
  enum class For { restart, start, state };

  /// `accept_changes`: a restart from another model is warned of, not refused.
  Checkpoint(std::string path, For use, const Origin& origin, bool accept_changes)
      : path_(std::move(path)), use_(use), origin_(origin), accept_changes_(accept_changes) {}

  /// The deck of the run that wrote a checkpoint. InputError, on every rank alike, where there is none. Collective.
  static Origin origin_of(const std::string& path, const RCP<const Comm>& comm);
  /// Whether an entry of the deck may be another one in what goes on.
  static bool may_change(For use, const std::string& path);

  /// Writes it; the old one stays until the new one is complete. RunError on every rank alike. Collective.
  void write(Model& model, const ExcessPressure& pressure, const Progress& progress, const HistoryOutput& history,
             const FieldOutput& fields) const;
  /// Keeps the checkpoint that is there under another name too. RunError on every rank alike. Collective.
  void keep_as(const std::string& path, const Comm& comm) const;

  /// Compares its deck with the run's. Returns the mesh of the last remeshing; null: the deck's. InputError, on every
  /// rank alike, when the checkpoint is missing, damaged, or that of another run. Collective.
  std::shared_ptr<const RemeshedMesh> open(const Mesh& mesh);
  /// Reads state and progress, after open(), for a model on the checkpoint's mesh. InputError like open(). Collective.
  void read(Model& model, const ExcessPressure& pressure, Progress& progress);
  /// After read(): lets the files of the results go on from `time` [s], where the checkpoint stands.
  void resume(double time, HistoryOutput& history, FieldOutput& fields) const;
  /// After read(): restores the memory of the linear solver, where the ranks have the parts that they had.
  void restore_solver(StepSystem& system) const;

 private:
  /// Throws InputError for a difference from the checkpoint's model unless the user accepts it; then it warns.
  void refuse_or_warn(const std::string& difference) const;
  void check_model() const;
  /// Checks that the stages so far are those of the deck. A stage goes on whose ends have changed.
  void check_stages(const Model& model, Progress& progress) const;
  void read_progress(Model& model, Progress& progress) const;

  std::string path_;
  For use_;
  const Origin& origin_;
  bool accept_changes_;
  std::string old_deck_;  // of open()
  CheckpointData data_;   // of read()
};

}  // namespace mudline
