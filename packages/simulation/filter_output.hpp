#pragma once

#include <vector>

#include "simulation/filter.hpp"
#include "simulation/observer.hpp"

namespace mudline {

/// Columns of the history for the filters of the deck's section "output/filters".
class FilterOutput : public Observer {
 public:
  explicit FilterOutput(std::vector<FilterSettings> settings) : settings_(std::move(settings)) {}
  void begin_run(const RunView& run) override { remeshed(run); }
  void remeshed(const RunView& run) override;
  void columns(const RunView& run, std::vector<HistoryValue>& to) override;

 private:
  const std::vector<FilterSettings> settings_;
  std::vector<Filter> filters_;  // on the run's present mesh
};

}  // namespace mudline
