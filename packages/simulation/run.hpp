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
  bool accept_changes = false;  // although the model is another, or results of before are missing
  bool overwrite = false;       // results of another deck
  int maximum_steps = 0;        // stop after so many accepted steps of this run, with a checkpoint; 0: no limit
  Doubts doubts;                // what is usual of what the run watches
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
  /// Where the run stands; together with the committed state it makes a restart exact.
  struct Progress {
    int stage = 0, step_in_stage = 0, step = 0;
    double stage_start = 0, next_dt = 0, last_dt = 0, next_field_time = 0;
    bool stage_open = false;  // the stage has begun
    int remesh_tried = 0;     // step after which that was
  };
  bool begin_stage(const Stage& stage);
  bool run_geostatic(const Stage& stage);
  ExitCode run_stage();
  const Stage& stage() const { return *model_->stages()[progress_.stage]; }
  bool take_step(const Stage& stage, double& dt, StepReport& report, ExitCode& exit);
  /// Takes a converged step over and moves the mesh where that is due. False, the state as before, when the mesh cannot
  /// be.
  bool accept(const Stage& stage, StepReport& report);
  bool moves_mesh(const Stage& stage) const;
  /// Whether the step that was found turns elements inside out that were not before.
  bool folds_elements() const;
  /// "" or why the mesh was not moved; the state is then undefined.
  std::string relocate_mesh();
  /// What a motion of the mesh or a mesh made anew changed, in a line, and in one more for layers.
  void tell_transfer(const MeshReceipt& receipt, const std::string& begin, void (*tell)(const std::string&));
  /// What it did to the layers.
  std::string layers_text(const MeshReceipt& receipt) const;
  bool remeshing_due();
  /// What the error estimate wants: see Ale::wanted_sizes.
  std::unique_ptr<const WantedSizes> wanted_sizes();
  /// Null where none is asked for.
  std::unique_ptr<DiscretisationError> make_error_estimate(Model& model) const;
  /// Goes on with a model on a mesh made anew, or, where that is refused, with the present one.
  void remesh();
  /// "", or why `next` cannot take the state over; it has then done so.
  std::string hand_over(std::unique_ptr<Model> next);
  /// What the history shows of the mesh.
  void report_mesh(Report& report) const;
  /// Measures the mesh of the committed state; warns once, where it is first poor.
  void look_at_mesh();
  /// Whether the run must end because elements are folded; says so then.
  bool ends_folded(const Stage& stage) const;
  /// Says how far the stage has dissipated the excess pore pressures on the walls of bodies at rest.
  void tell_dissipation(const Stage& stage);
  void after_step(const Stage& stage, double dt, const StepReport& report);
  /// The first multiple of the field interval, from the stage's start, after `time`.
  double next_field_time(double time) const;
  double choose_dt(const Stage& stage) const;
  LocalError local_error(const Stage& stage) const;
  /// Numbers the increment that comes next; `taken`: steps beside those that are counted.
  void count_increment(int taken);
  StepRequest request(const Stage& stage, double dt) const;
  void reset_displacements();
  /// Balances, excess pressures and errors are counted from the committed state.
  void take_start();
  /// What terms, contacts that do not act, and conditions report. Collective.
  Report report_terms();
  /// Of the contacts alone, in the committed state. Collective.
  Report report_contacts();
  /// The last step's row of the history, where that has not been written yet.
  void write_row();
  /// Saves where the run ends within a stage; then come rows that the run would not write here if it went on, which a
  /// restart drops.
  void save_and_end();
  void log_step(const Stage& stage, double dt, const StepReport& report) const;
  bool stop_requested() const;
  void save_checkpoint();
  /// InputError, on every rank alike, when the checkpoint is missing, damaged, or that of another run.
  void load_checkpoint();
  /// A difference from the checkpoint's model: InputError unless the user accepts it.
  /// The model on the mesh of a checkpoint that has one of its own.
  void load_mesh(const CheckpointReader& reader);
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
  CheckpointData checkpoint_;  // that a restart began from
  LocalError error_;           // of the step last tried
  Report report_;              // of its terms
  int iterations_ = 0;         // of the last step
  bool row_is_due_ = false;    // of the last step, in the history
  int steps_here_ = 0;
  int rejected_ = 0;
  MeshQuality quality_;        // of the committed state's mesh
  bool poor_mesh_ = false;     // that was said
  bool started_anew_ = false;  // likewise, of laws
  double wall_start_ = 0;
};

/// From now on SIGINT, SIGTERM, SIGUSR1 and SIGHUP (unless it is ignored, as under nohup) ask the run to stop after the
/// present step; a second SIGINT or SIGTERM ends at once.
void catch_signals();

}  // namespace mudline
