#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "integrator/stepper.hpp"
#include "simulation/balances.hpp"
#include "simulation/checkpoint.hpp"
#include "simulation/error_output.hpp"
#include "simulation/excess_pressure.hpp"
#include "simulation/field_output.hpp"
#include "simulation/history_output.hpp"
#include "simulation/model.hpp"
#include "simulation/old_results.hpp"
#include "simulation/output/result_lock.hpp"
#include "simulation/stage_ends.hpp"
#include "simulation/transfer_log.hpp"

namespace mudline {

/// How a run ended; the program's exit code.
enum class ExitCode { done = 0, failure = 1, input_error = 2, no_convergence = 3, stopped = 4 };

struct RunOptions {
  bool restart = false;         // continue from the checkpoint of the same name, if there are results
  std::string start = {};       // checkpoint of another run to start from; "": a new start
  bool accept_changes = false;  // restart even if the model differs or earlier results are missing
  bool overwrite = false;       // replace results of another deck
  /// Pore pressures by overlap dof from which a new start counts excess pressures; empty: those that it starts with
  NodalView reference_pressure = {};
  int maximum_steps = 0;  // stop after so many accepted steps of this run, with a checkpoint; 0: no limit
};

/// Makes a model of the run's deck on another mesh. InputError on every rank alike. Collective.
using ModelMaker = std::function<std::unique_ptr<Model>(std::shared_ptr<const RemeshedMesh> mesh)>;

/// Runs the stages of a model: steps, cuts, mesh motion, remeshing, checkpoints, signals. What is written and told
/// besides is the matter of its observers.
class Run {
 public:
  /// `origin`: kept in the results; `watchers`: observers beside the run's own. InputError when a restart does not fit,
  /// when another run writes the same results, or when those of another deck are in the way. Collective.
  Run(std::unique_ptr<Model> model, ModelMaker make_model, const OutputSettings& settings, const Origin& origin,
      const RunOptions& options, Observers watchers);
  ExitCode execute();

 private:
  bool begin_stage(const Stage& stage);
  bool run_geostatic(const Stage& stage);
  ExitCode run_stage();
  const Stage& stage() const { return *model_->stages()[progress_.stage]; }
  bool take_step(const Stage& stage, double& dt, StepReport& report, ExitCode& exit);
  /// Accepts a converged step and moves the mesh where that is due. False, with the state as before, when the mesh
  /// cannot be moved.
  bool accept(const Stage& stage, StepReport& solve);
  bool moves_mesh(const Stage& stage) const;
  /// Moves the mesh. Returns "" or why it was not moved; the state is then undefined.
  std::string relocate_mesh();
  bool remeshing_due();
  /// Element sizes that the error estimate wants: see Ale::wanted_sizes.
  std::unique_ptr<const WantedSizes> wanted_sizes();
  /// Remeshes and goes on with a model on the new mesh, or, where that is refused, with the present one.
  void remesh();
  /// Transfers the state to `next` and makes it the run's model. Returns "", or why the state cannot be transferred.
  std::string transfer_to(std::unique_ptr<Model> next);
  void after_step(const Stage& stage, double dt, const StepReport& report);
  /// Tells the observers' objections to going on. Returns whether there are any.
  bool observers_object();
  double choose_dt(const Stage& stage) const;
  LocalError local_error(const Stage& stage) const;
  /// Sets the number of the next increment; `taken`: steps that are not counted in the progress yet.
  void count_increment(int taken);
  StepRequest request(const Stage& stage, double dt) const;
  /// Why a converged step is no equilibrium: the soil moves too far for the growth of a strength reduction's factor;
  /// "": it is one. Collective.
  std::string flows(const Stage& stage) const;
  /// Ends a stage whose strength reduction finds no equilibrium for a step of length `dt`.
  void end_reduction(const Stage& stage, double dt, const std::string& reason);
  /// The largest component of the displacement of the trial state from the committed one [m]. Collective.
  double largest_displacement() const;
  void reset_displacements();
  /// Takes the committed state as the start of balances, excess pressures and observers.
  void take_start();
  /// Makes a model that of the run.
  void take_model(std::unique_ptr<Model> model);
  void make_observers(Observers watchers);
  RunView view(bool resumed = false) const;
  void tell(const std::function<void(Observer&)>& action);
  void tell(void (Observer::*event)(const RunView&), bool resumed = false);
  /// Tells the observers of an accepted step, after they have added to its report. Collective.
  void tell_step(const StepReport& solve);
  /// Tells the observers that the run ends; with a checkpoint before.
  void end(RunEnd how);
  void save_and_end(RunEnd how);
  bool stop_requested() const;
  void save_checkpoint();
  /// Keeps the checkpoint at the end of the present stage, from which other runs may start.
  void keep_checkpoint() const;
  /// Makes the model and the state those of a checkpoint.
  void go_on_from(Checkpoint& checkpoint);

  std::unique_ptr<Model> model_;
  ModelMaker make_model_;
  OutputSettings settings_;
  const std::string stem_ = settings_.stem();  // of the names of all files
  Origin origin_;
  RunOptions options_;
  std::unique_ptr<ResultLock> lock_;
  std::unique_ptr<Balances> balances_;
  std::unique_ptr<ExcessPressure> pressure_;
  Observers observers_;
  // those of the observers that the run needs for more than telling
  ErrorOutput* error_estimate_ = nullptr;  // null: not asked for
  HistoryOutput* history_ = nullptr;
  FieldOutput* fields_ = nullptr;
  std::unique_ptr<StageEnds> ends_;
  Progress progress_;
  Checkpoint checkpoint_;
  LocalError error_;  // estimate for the step last tried
  Report report_;     // report of the last accepted step
  StepReport solve_;  // likewise, its iterations
  int steps_here_ = 0;
  int rejected_ = 0;
  double mesh_time_ = 0;    // wall-clock seconds of mesh motion and remeshing
  double lost_factor_ = 0;  // of the strengths, that ended the stage; 0: none did
  TransferLog transfers_;
};

/// From now on SIGINT, SIGTERM, SIGUSR1 and SIGHUP (unless it is ignored, as under nohup) ask the run to stop after the
/// present step; a second SIGINT or SIGTERM ends at once.
void catch_signals();

}  // namespace mudline
