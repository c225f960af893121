#pragma once

#include <memory>
#include <string>

#include "simulation/balances.hpp"
#include "simulation/output/checkpoint_file.hpp"
#include "simulation/model.hpp"
#include "simulation/results.hpp"

namespace mudline {

/// How a run ended; the program's exit code.
enum class ExitCode { done = 0, failure = 1, input_error = 2, no_convergence = 3, stopped = 4 };

struct RunOptions {
  bool restart = false;    // continue from the checkpoint of the same name
  int maximum_steps = 0;   // stop after so many accepted steps of this run, with a checkpoint; 0: no limit
};

/// Runs the stages of a model: steps, cuts, outputs, checkpoints, signals.
class Run {
 public:
  /// `deck_text`: the deck as run, kept in the results. InputError when a restart does not fit. Collective.
  Run(Model& model, const OutputSettings& settings, const std::string& deck_text, const RunOptions& options);
  ExitCode execute();

 private:
  /// Where the run stands; together with the committed state it makes a restart exact.
  struct Progress {
    int stage = 0, step_in_stage = 0, step = 0;
    double stage_start = 0, next_dt = 0, next_field_time = 0;
    bool stage_open = false;   // the stage has begun
  };
  bool begin_stage(const Stage& stage);
  bool run_geostatic(const Stage& stage);
  ExitCode run_stage(const Stage& stage);
  bool take_step(const Stage& stage, double& dt, StepReport& report, ExitCode& exit);
  /// Takes a converged step over and moves the mesh where that is due. False, the state as before, when the mesh cannot be.
  bool accept(const Stage& stage, StepReport& report);
  bool moves_mesh(const Stage& stage) const;
  /// "" or why the mesh was not moved; the state is then undefined.
  std::string relocate_mesh();
  /// Once, where the moved mesh is worse than the deck accepts.
  void warn_of_quality(const MeshReceipt& receipt);
  void after_step(const Stage& stage, double dt, const StepReport& report);
  double choose_dt(const Stage& stage) const;
  double local_error(const Stage& stage) const;
  StepRequest request(const Stage& stage, double dt) const;
  void reset_displacements();
  std::map<std::string, double> term_histories();
  void log_step(const Stage& stage, double dt, const StepReport& report) const;
  bool stop_requested() const;
  void save_checkpoint();
  void load_checkpoint();
  void restore_state();
  void restore_initial_pressure();
  void restore_solver();
  std::string checkpoint_path() const { return settings_.stem() + ".restart"; }

  Model& model_;
  OutputSettings settings_;
  RunOptions options_;
  Balances balances_;
  std::unique_ptr<Results> results_;
  Progress progress_;
  CheckpointData checkpoint_;   // that a restart began from
  double error_ = 0;                         // of the step last accepted, in units of the tolerance
  std::map<std::string, double> histories_;  // of its terms
  int steps_here_ = 0;
  int rejected_ = 0;
  bool poor_mesh_ = false;  // that was said
  double wall_start_ = 0;
};

/// From now on SIGINT and SIGTERM ask the run to stop after the present step; a second one ends at once.
void catch_signals();

}  // namespace mudline
