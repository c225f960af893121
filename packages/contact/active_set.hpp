#pragma once

#include <functional>
#include <optional>
#include <string>

#include "framework/term_faces.hpp"

namespace mudline {

enum class ActiveSetLoop { in_newton, outer };

/// What the deck says of the loop over the sets of points that press.
struct ActiveSetParameters {
  ActiveSetLoop loop = ActiveSetLoop::in_newton;
  int most_changes = 3, most_updates = 30;
  bool outer() const { return loop == ActiveSetLoop::outer; }
  void parameters(Parameters& p);
  /// InputError for entries that have no meaning without the loop.
  void check(const Section& section) const;
};

/// The set of contact points that press, fixed while Newton's method solves a step: a point of the set has its
/// penalty's spring in tension too, the others none. After each solve points in tension leave and points that penetrate
/// enter, and the step is solved again, until the set stays. Guard against chatter: a point that has changed as often
/// as allowed in a step takes the state in which it violates its condition less, and keeps it; where it then violates
/// it by more than the gap tolerance, the step is refused.
///
/// State array "<prefix>active set", a row per point and one for the number of updates: in the trial state alone, so
/// that a rejected step leaves nothing.
class ActiveSet {
 public:
  /// [m] of a point, negative where the spring presses; positive for one that sees nothing.
  using Gap = std::function<double(int row)>;

  /// `ids`: of the points' rows, see ArrayInfo.
  void declare_state(StateStore& store, const std::string& prefix, const std::vector<long long>& ids);
  bool used() const { return array_ >= 0; }
  /// Handle of the array.
  int array() const { return array_; }
  /// At the start of a step.
  void start(const State& trial, const std::function<bool(int row)>& presses) const;
  bool holds(const State& trial, int row) const { return trial.arrays[array_](row, 0) > 0; }
  int updates(const State& trial) const { return static_cast<int>(trial.arrays[array_](rows_, 0)); }
  /// After a solve. Nothing: the set stays. Else the step is to be solved again, or refused. Collective.
  std::optional<Augmentation> update(const State& trial, const std::string& contact, const ActiveSetParameters& deck,
                                     double gap_tolerance, const Gap& gap, const Comm& comm) const;

 private:
  int array_ = -1, rows_ = 0;
};

}  // namespace mudline
