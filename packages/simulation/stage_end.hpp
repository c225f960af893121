#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/registry.hpp"

namespace mudline {

class Model;
struct HistoryValue;
struct RunView;

/// What ends a stage before its duration is over: an entry of its section "ends when". It watches one number.
class StageEnd {
 public:
  virtual ~StageEnd() = default;
  std::string name;  // of the deck's entry

  /// Checks its entries (section.fail) against the model, whose state is not made yet.
  virtual void bind(const Model&, const Section&) {}
  /// Whether it reads columns of the history.
  virtual bool needs_columns() const { return false; }
  /// Checks its entries against the columns of the history, before the first stage. InputError.
  virtual void check(const std::vector<HistoryValue>&) {}
  /// The number that it watches, after a step or when the stage begins; `row`: the columns of the history, none when
  /// the stage begins. Collective.
  virtual double measure(const RunView& run, const std::vector<HistoryValue>& row) const = 0;
  /// Whether the stage is over. `largest`: the largest magnitude that the number has had in the stage.
  virtual bool reached(double now, double largest) const = 0;
  /// What was reached, as the log tells it.
  virtual std::string told_end(double now, double largest) const = 0;
};

/// "at rest", "dissipated", "history".
void register_stage_ends(Registry<StageEnd>& registry);

/// The largest magnitudes, in the present stage, of what its ends watch, by their names.
using StageEndMemory = std::map<std::string, double>;

}  // namespace mudline
