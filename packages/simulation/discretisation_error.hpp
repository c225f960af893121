#pragma once

#include <map>
#include <string>
#include <vector>

#include "physics/error_estimate.hpp"
#include "simulation/model.hpp"
#include "simulation/output/field_file.hpp"
#include "simulation/output/history_file.hpp"

namespace mudline {

/// The discretisation error in the output: fields, global shares, and an error beside every resistance. A coarse mesh
/// resists a motion with too much power; the error of this power is the power of the error of the recovered stress on
/// the error of the recovered strain rate.
class DiscretisationError {
 public:
  /// Declares its state array; to be called before the first step. `target`: wanted relative error of the stress [-].
  /// Collective.
  DiscretisationError(Model& model, double target);
  const Model& model() const { return model_; }
  /// Takes the committed stress as the one from which changes are counted.
  void start();
  /// Forgets the largest speeds of the motions; to be called when a stage begins.
  void begin_stage();
  /// Estimates the error of the committed state. `excess`: excess pore pressure [Pa] by overlap dof. Collective.
  void evaluate(const NodalView& excess);

  /// Fields by cell, of the last evaluation.
  std::vector<OutputField> fields() const;
  /// Columns of the history, of the last evaluation. `terms`: report of the terms on the last step; the errors of
  /// resistances are stored in the committed state. Collective.
  std::vector<HistoryValue> values(const Report& terms);
  /// Wanted size [m] of each element of this rank, block after block.
  const std::vector<double>& wanted_sizes() const { return estimate_.wanted; }
  /// Error of the pore pressure [Pa] of each element of this rank, block after block; empty without pore fluid.
  const std::vector<double>& pressure() const { return estimate_.pressure; }

 private:
  /// A motion that the soil resists: that of a body with its contacts, or of a condition.
  struct Motion {
    std::string name;
    const RigidBody* body = nullptr;
    const Condition* condition = nullptr;
    std::vector<std::string> reactions;  // columns, without the axis
  };
  /// Rows of each motion in the state array: relative error of the resistance, largest speed in the stage.
  enum Row { share, fastest, rows };
  /// Power [W] of the resistance to a motion, and the motion's speed [m/s].
  struct Resisted {
    double power = 0, speed = 0;
  };
  Resisted resisted(const Motion& motion, const Report& terms) const;

  Model& model_;
  double target_;
  ErrorEstimator estimator_;
  ErrorEstimate estimate_;
  std::vector<Motion> motions_;
  int handle_;
};

}  // namespace mudline
