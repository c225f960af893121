#include "simulation/error_output.hpp"

#include "simulation/excess_pressure.hpp"

namespace mudline {

void ErrorOutput::declare_state(Model& model) { next_ = std::make_unique<DiscretisationError>(model, target_); }

DiscretisationError& ErrorOutput::on(const RunView& run) {
  if (next_ && &next_->model() == &run.model) now_ = std::move(next_);
  return *now_;
}

DiscretisationError& ErrorOutput::evaluated(const RunView& run) {
  on(run).evaluate(run.model.soil()->pressure >= 0 ? run.pressure.values() : NodalView());
  return *now_;
}

void ErrorOutput::begin_stage(const RunView& run) {
  if (!run.resumed) on(run).begin_stage();
}

void ErrorOutput::columns(const RunView& run, std::vector<HistoryValue>& to) {
  for (const HistoryValue& value : evaluated(run).values(run.report)) to.push_back(value);
}

void ErrorOutput::cell_fields(const RunView& run, std::vector<OutputField>& to) {
  for (OutputField& field : evaluated(run).fields()) to.push_back(std::move(field));
}

const std::vector<double>& ErrorOutput::wanted_sizes(const RunView& run) { return evaluated(run).wanted_sizes(); }

}  // namespace mudline
