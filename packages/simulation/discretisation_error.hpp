#pragma once

#include <map>
#include <string>
#include <vector>

#include "physics/error_estimate.hpp"
#include "simulation/model.hpp"
#include "simulation/output/field_file.hpp"
#include "simulation/output/history_file.hpp"

namespace mudline {

/// What the output says of the discretisation error: fields, global shares, and an error beside every resistance. The
/// mesh resists a motion by too much power; its error is that of the recovered stress on the recovered strain rate.
class DiscretisationError {
 public:
  /// Declares its arrays. Before the first step. `target`: wanted share of the error of the stress. Collective.
  DiscretisationError(Model& model, double target);
  /// The committed stress is the start from which changes are counted.
  void start();
  /// When a stage begins: how fast its motions are is not known.
  void begin_stage();
  /// Estimates that of the committed state. excess: pore pressure by overlap dof. Collective.
  void evaluate(const NodalView& excess);

  /// By cell, of the last evaluation.
  std::vector<OutputField> fields() const;
  /// Columns of the history, of the last evaluation. `terms`: what the terms say of the last step; the errors of
  /// resistances are noted in the committed state. Collective.
  std::vector<HistoryValue> values(const Report& terms);
  /// [m] by element of this rank, block after block.
  const std::vector<double>& wanted_sizes() const { return estimate_.wanted; }
  /// [Pa] by element of this rank, block after block; empty without pore fluid.
  const std::vector<double>& pressure() const { return estimate_.pressure; }

 private:
  /// What moves and is resisted: a body with its contacts, or a condition.
  struct Motion {
    std::string name;
    const RigidBody* body = nullptr;
    const Condition* condition = nullptr;
    std::vector<std::string> reactions;  // columns, without the axis
  };
  /// Of each motion, in the state.
  enum Row { share, fastest, rows };
  /// Power [W] and speed [m/s] of what resists a motion. Collective.
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
