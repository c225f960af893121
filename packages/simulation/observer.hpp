#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/registry.hpp"
#include "framework/report.hpp"

namespace mudline {

class Balances;
class ExcessPressure;
class Model;
class ResultTable;
class Stage;
struct HistoryValue;
struct OutputField;
struct State;
struct StepReport;

/// What an observer sees of a run after a step, or at the start or end of a stage or of the run.
struct RunView {
  const Model& model;        // on its present mesh; another object after a remeshing
  const State& state;        // committed
  const Stage& stage;        // the present one, or the next one where the run has just begun
  bool resumed;              // the run or the stage, as the call says, goes on from a checkpoint
  bool at_end;               // the end of the stage is reached
  double stage_start;        // [s]
  int step;                  // number of accepted steps of the run, the geostatic ones among them
  double dt;                 // [s] length of the last step; 0: none so far, or geostatic
  int rejected;              // number of rejected steps since the program started
  double mesh_time;          // wall-clock seconds of this rank for mesh motion and remeshing since the program started
  const StepReport& solve;   // of the last step
  const Report& report;      // of terms, conditions and observers on the last step; at the start of a stage of contacts
  const Balances& balances;  // sums over the run
  const ExcessPressure& pressure;  // pore pressure less that of the start
  const std::string& stem;         // of the names of the run's files: "results/pile"
  double lost_factor;  // [-] over which the strengths find no equilibrium, which ended the stage; 0: none did
};

/// How a run ends: done; interrupted, to be continued from its checkpoint; or failed within a stage.
enum class RunEnd { done, interrupted, failed };

/// Somebody who watches a run: an output, or a watch that warns. It changes nothing of the state but its own arrays.
///
/// An entry of the deck's "output/observers" names a registered type; the program adds its own observers. Every
/// function is called on all ranks alike and may communicate. What it throws ends the run with a line that names it.
class Observer {
 public:
  virtual ~Observer() = default;
  std::string name;  // of the deck's entry; "": one of the program's own

  /// Checks its entries against the model before the run (section.fail).
  virtual void bind(const Model&, const Section&) {}
  /// Declares arrays of the state in which it keeps what a restart needs. Called for the model of the run before its
  /// start, and for the model on a new mesh before the state is transferred to it.
  virtual void declare_state(Model&) {}

  virtual void begin_run(const RunView&) {}
  /// The committed state is the start, with displacements of zero: at the begin of a run and after geostatic stages.
  virtual void take_start(const RunView&) {}
  virtual void begin_stage(const RunView&) {}
  /// Adds to the report of a step, before step().
  virtual void report(const RunView&, Report&) {}
  /// A step was accepted, with the mesh motion after it.
  virtual void step(const RunView&) {}
  /// The run goes on with a model on a new mesh.
  virtual void remeshed(const RunView&) {}
  virtual void end_stage(const RunView&) {}
  virtual void end_run(const RunView&, RunEnd) {}

  /// Why the run must not go on from this step; "": it goes on. The state is saved and the run ends with an error.
  virtual std::string objection(const RunView&) { return ""; }
  /// Adds columns to a row of the history that is about to be written, always the same ones.
  virtual void columns(const RunView&, std::vector<HistoryValue>&) {}
  /// Sets results of the present stage ("<stem>.results.csv"), after each step that is not geostatic; the table keeps
  /// them through a restart.
  virtual void results(const RunView&, ResultTable&) {}
  /// Adds fields by element of this rank, block after block, to the fields that are about to be written.
  virtual void cell_fields(const RunView&, std::vector<OutputField>&) {}
};

using Observers = std::vector<std::unique_ptr<Observer>>;

/// Makes the observers of the section "output/observers" and binds them to the model. InputError.
Observers read_observers(const Section& output, const Registry<Observer>& types, const Model& model);

/// Calls `action` on an observer. What one of the deck throws on any rank, but InputError and RunError, becomes a
/// RunError on all. Collective.
void call(Observer& observer, const Model& model, const std::function<void(Observer&)>& action);

}  // namespace mudline
