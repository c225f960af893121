#pragma once

#include "simulation/observer.hpp"
#include "simulation/results/result_table.hpp"

namespace mudline {

constexpr const char* factor_of_safety = "factor of safety";  // names of results
constexpr const char* factor_without_equilibrium = "factor without equilibrium";
constexpr const char* factor_with_equilibrium = "factor with equilibrium";  // where no larger one was tried

/// The factor by which a strength reduction divides strengths, in the history, and the factor of safety that a stage
/// finds by it, or the factor up to which it finds equilibrium, in the results.
class SafetyResults : public Observer {
 public:
  /// `table`: kept with the run's progress.
  explicit SafetyResults(ResultTable& table) : table_(table) {}
  void columns(const RunView& run, std::vector<HistoryValue>& row) override;
  void end_stage(const RunView& run) override;

 private:
  ResultTable& table_;
};

}  // namespace mudline
