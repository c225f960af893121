#include "simulation/history_output.hpp"

#include "integrator/stepper.hpp"
#include "simulation/balances.hpp"
#include "simulation/error_output.hpp"
#include "simulation/excess_pressure.hpp"
#include "simulation/output/collective.hpp"
#include "simulation/state_fields.hpp"

namespace mudline {

void HistoryOutput::begin_run(const RunView& run) {
  file_ = std::make_unique<HistoryFile>(run.model.mesh().comm(), settings_.stem() + ".csv", restart_);
  remeshed(run);
}

void HistoryOutput::remeshed(const RunView& run) {
  probes_ = std::make_unique<Probes>(run.model, settings_.probes);
  row_step_ = -1;
}

void HistoryOutput::step(const RunView& run) {
  due_ = true;
  if (run.at_end || run.step % settings_.history_steps == 0) write_due_row(run);
}

void HistoryOutput::end_run(const RunView& run, RunEnd end) {
  write_due_row(run);
  if (end != RunEnd::done) return;
  const Comm& comm = *run.model.mesh().comm();
  end_where_lost(raw_communicator(comm), comm.getRank() == 0 ? file_->lost() : "");
}

void HistoryOutput::write_due_row(const RunView& run) {
  if (due_) file_->write(run.state.time, row(run));
  due_ = false;
}

const std::vector<HistoryValue>& HistoryOutput::row(const RunView& run) {
  if (row_step_ != run.step) row_ = columns_after(run);
  row_step_ = run.step;
  return row_;
}

std::vector<HistoryValue> HistoryOutput::columns_after(const RunView& run) const {
  std::vector<HistoryValue> row{{"step/dt", "s", run.dt},
                                {"step/newton iterations", "-", static_cast<double>(run.solve.newton_iterations)}};
  for (const auto& [name, body] : run.model.bodies()) {
    const auto add = [&, name = name, axes = body->dimension()](const char* what, const char* unit, const Point& x) {
      for (int i = 0; i < axes; ++i) row.push_back({"body/" + name + what + axis_names[i], unit, x[i]});
    };
    add("/position ", "m", body->position(run.state));
    add("/displacement ", "m", body->displacement(run.state));
    add("/velocity ", "m/s", body->velocity(run.state));
    if (body->dimension() == 2) continue;
    add("/rotation ", "rad", body->rotation(run.state));
    add("/spin ", "rad/s", body->spin(run.state));
  }
  for (const auto& [name, quantity] : run.report) row.push_back({name, quantity.unit, quantity.value});
  for (const auto& observer : observers_) call(*observer, run.model, [&](Observer& one) { one.columns(run, row); });
  const std::vector<double>* const error = error_ != nullptr ? &error_->pressure() : nullptr;
  for (const HistoryValue& value : probes_->values(
           run.state, [&] { return run.pressure.values(); }, error))
    row.push_back(value);
  for (const HistoryValue& value : run.balances.values()) row.push_back(value);
  for (const HistoryValue& value : state_sums(run.model)) row.push_back(value);
  return row;
}

}  // namespace mudline
