#include "simulation/filter_output.hpp"

#include "simulation/excess_pressure.hpp"
#include "simulation/output/history_file.hpp"

namespace mudline {

void FilterOutput::remeshed(const RunView& run) {
  filters_.clear();
  for (const FilterSettings& filter : settings_) filters_.emplace_back(run.model, filter);
}

void FilterOutput::columns(const RunView& run, std::vector<HistoryValue>& to) {
  if (filters_.empty()) return;
  const std::vector<Filter::Value> values = Filter::values(filters_, run.state, run.pressure.values());
  for (std::size_t k = 0; k < filters_.size(); ++k) {
    const Filter::Value& value = values[k];
    const std::string start = "filter/" + filters_[k].settings().name + "/";
    to.push_back({start + "pore pressure", "Pa", value.pressure});
    to.push_back({start + "excess pore pressure", "Pa", value.excess});
    to.push_back({start + "pore pressure error", "Pa", value.error});
    to.push_back({start + "covered share", "-", value.covered});
  }
}

}  // namespace mudline
