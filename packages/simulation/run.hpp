#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "discretisation/mesh_quality.hpp"
#include "simulation/balances.hpp"
#include "simulation/model.hpp"
#include "simulation/old_results.hpp"
#include "simulation/output/checkpoint_file.hpp"
#include "simulation/output/result_lock.hpp"
#include "simulation/penetration_watch.hpp"
#include "simulation/results.hpp"
#include "simulation/wall_dissipation.hpp"

namespace mudline {

/// How a run ended; the program's exit code.
enum class ExitCode { done = 0, failure = 1, input_error = 2, no_convergence = 3, stopped = 4 };

struct RunOptions {
  bool restart = false;         // continue from the checkpoint of the same name
  bool accept_changes = false;  // restart even if the model differs or earlier results are missing
  bool overwrite = false;       // replace results of another deck
  int maximum_steps = 0;        // stop after so many accepted steps of this run, with a checkpoint; 0: no limit
  Doubts doubts;                // usual ranges of the quantities that the run watches
};

/// Makes a model of the run's deck on another mesh. InputError on every rank alike. Collective.
using ModelMaker = std::function<std::unique_ptr<Model>(std::shared_ptr<const RemeshedMesh> mesh)>;

/// Runs the stages of a model: steps, cuts, outputs, checkpoints, signals.
class Run {
 public:
  /// `origin`: kept in the results. InputError when a restart does not fit, when another run writes the same results,
  /// or when those of another deck are in the way. Collective.
  Run(std::unique_ptr<Model> model, ModelMaker make_model, const OutputSettings& settings, const Origin& origin,
      const RunOptions& options);
  ExitCode execute();

 private:
  /// Progress of the run; together with the committed state it makes a restart exact.
  struct Progress {
    int stage = 0, step_in_stage = 0, step = 0;
    double stage_start = 0, next_dt = 0, last_dt = 0, next_field_time = 0;
    bool stage_open = false;  // the stage has begun
    int remesh_tried = 0;     // step after which remeshing was last tried
  };
  bool begin_stage(const Stage& stage);
  bool run_geostatic(const Stage& stage);
  ExitCode run_stage();
  const Stage& stage() const { return *model_->stages()[progress_.stage]; }
  bool take_step(const Stage& stage, double& dt, StepReport& report, ExitCode& exit);
  /// Accepts a converged step and moves the mesh where that is due. False, with the state as before, when the mesh
  /// cannot be moved.
  bool accept(const Stage& stage, StepReport& report);
  bool moves_mesh(const Stage& stage) const;
  /// Whether the trial state turns elements inside out that were not before.
  bool folds_elements() const;
  /// Moves the mesh. Returns "" or why it was not moved; the state is then undefined.
  std::string relocate_mesh();
  /// Tells in a line what a mesh motion or a remeshing changed, and in one more what it changed in layers.
  void tell_transfer(const MeshReceipt& receipt, const std::string& begin, void (*tell)(const std::string&));
  /// Text on what a transfer changed in the layers.
  std::string layers_text(const MeshReceipt& receipt) const;
  bool remeshing_due();
  /// Element sizes that the error estimate wants: see Ale::wanted_sizes.
  std::unique_ptr<const WantedSizes> wanted_sizes();
  /// The error estimate of a model; null where none is asked for.
  std::unique_ptr<DiscretisationError> make_error_estimate(Model& model) const;
  /// Remeshes and goes on with a model on the new mesh, or, where that is refused, with the present one.
  void remesh();
  /// Transfers the state to `next` and makes it the run's model. Returns "", or why the state cannot be transferred.
  std::string transfer_to(std::unique_ptr<Model> next);
  /// Adds the mesh's columns of the history to a report.
  void report_mesh(Report& report) const;
  /// Measures the mesh of the committed state; warns once, where it is first poor.
  void look_at_mesh();
  /// Whether the run must end because elements are folded; logs an error then.
  bool ends_folded(const Stage& stage) const;
  /// Logs how far the stage has dissipated the excess pore pressures on the walls of bodies at rest.
  void tell_dissipation(const Stage& stage);
  void after_step(const Stage& stage, double dt, const StepReport& report);
  /// The first multiple of the field interval, from the stage's start, after `time`.
  double next_field_time(double time) const;
  double choose_dt(const Stage& stage) const;
  LocalError local_error(const Stage& stage) const;
  /// Sets the number of the next increment; `taken`: steps that are not counted in the progress yet.
  void count_increment(int taken);
  StepRequest request(const Stage& stage, double dt) const;
  void reset_displacements();
  /// Takes the committed state as the start of balances, excess pressures and errors.
  void take_start();
  /// Report of the terms, of contacts that do not act, and of conditions. Collective.
  Report report_terms();
  /// Report of the contacts alone, in the committed state. Collective.
  Report report_contacts();
  /// Writes the last step's row of the history, where that has not been written yet.
  void write_row();
  /// Saves a checkpoint where the run ends within a stage, and then writes a row that a run without this end may not
  /// have; a restart drops it.
  void save_and_end();
  void log_step(const Stage& stage, double dt, const StepReport& report) const;
  bool stop_requested() const;
  void save_checkpoint();
  /// Throws InputError, on every rank alike, when the checkpoint is missing, damaged, or that of another run.
  void load_checkpoint();
  /// Makes the model on the mesh of a checkpoint that has a mesh of its own.
  void load_mesh(const CheckpointReader& reader);
  /// Throws InputError for a difference from the checkpoint's model unless the user accepts it; then it warns.
  void refuse_or_warn(const std::string& difference) const;
  void check_model(const std::string& old_deck) const;
  void check_stages(const std::string& old_deck) const;
  void restore_progress();
  void restore_arrays();
  void restore_initial_pressure();
  ResultsRestart results_restart() const;
  void restore_solver();
  std::string checkpoint_path() const { return settings_.stem() + ".restart"; }

  std::unique_ptr<Model> model_;
  ModelMaker make_model_;
  OutputSettings settings_;
  Origin origin_;
  RunOptions options_;
  std::unique_ptr<ResultLock> lock_;
  PenetrationWatch penetration_;
  std::unique_ptr<Balances> balances_;
  std::unique_ptr<DiscretisationError> error_estimate_;  // null: not asked for
  std::unique_ptr<Results> results_;
  WallDissipation walls_;
  Progress progress_;
  CheckpointData checkpoint_;  // checkpoint of the restart
  LocalError error_;           // estimate for the step last tried
  Report report_;              // report of that step's terms
  int iterations_ = 0;         // Newton iterations of the last step
  bool row_is_due_ = false;    // the last step's row of the history is not written yet
  int steps_here_ = 0;
  int rejected_ = 0;
  MeshQuality quality_;          // quality of the committed state's mesh
  bool poor_mesh_ = false;       // the warning was given
  bool restarted_laws_ = false;  // likewise, that laws were started anew
  double wall_start_ = 0;
};

/// From now on SIGINT, SIGTERM, SIGUSR1 and SIGHUP (unless it is ignored, as under nohup) ask the run to stop after the
/// present step; a second SIGINT or SIGTERM ends at once.
void catch_signals();

}  // namespace mudline
