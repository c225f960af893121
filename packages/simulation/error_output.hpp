#pragma once

#include <memory>
#include <vector>

#include "simulation/discretisation_error.hpp"
#include "simulation/observer.hpp"

namespace mudline {

/// The estimate of the discretisation error in fields and history. It is evaluated whenever one of them is written.
class ErrorOutput : public Observer {
 public:
  /// `target`: wanted relative error of the stress [-].
  explicit ErrorOutput(double target) : target_(target) {}
  void declare_state(Model& model) override;
  void take_start(const RunView& run) override { on(run).start(); }
  void begin_stage(const RunView& run) override;
  void remeshed(const RunView& run) override { on(run); }
  void columns(const RunView& run, std::vector<HistoryValue>& to) override;
  void cell_fields(const RunView& run, std::vector<OutputField>& to) override;

  /// Evaluates and returns the wanted size [m] of each element of this rank, block after block. Collective.
  const std::vector<double>& wanted_sizes(const RunView& run);
  /// Error of the pore pressure [Pa] of each element of this rank in the last row of the history.
  const std::vector<double>& pressure() const { return now_->pressure(); }

 private:
  /// The estimate on the run's present mesh.
  DiscretisationError& on(const RunView& run);
  DiscretisationError& evaluated(const RunView& run);

  const double target_;
  std::unique_ptr<DiscretisationError> now_, next_;  // on the present mesh; on the mesh that may follow
};

}  // namespace mudline
