#pragma once

#include <string>
#include <vector>

#include "core/parameters.hpp"
#include "framework/state.hpp"

namespace mudline {

/// Initial gaps of a contact: the deck entries, and the state array "<prefix>initial gap" with a row per point (offset
/// [m], by which the counted gap is smaller than the geometric one). Without an adjustment there is no array.
class InitialGap {
 public:
  void parameters(Parameters& p);
  /// InputError for entries that have no meaning here.
  void check(const Section& section) const;
  bool adjusts() const { return start_ != Start::as_placed; }
  /// Whether the points start pressed by the soil's stress.
  bool presses() const { return start_ == Start::in_situ_stress; }
  /// Farthest distance [m] of a point of a side with this longest edge [m] that is adjusted.
  double reach(double edge) const { return distance_ > 0 ? distance_ : 0.1 * edge; }

  void declare_state(StateStore& store, const std::string& prefix, std::shared_ptr<const SurfacePoints> at);
  double offset(const State& state, int row) const { return array_ < 0 ? 0.0 : state.arrays[array_](row, 0); }
  void set_offset(const State& state, int row, double offset) const { state.arrays[array_](row, 0) = offset; }

 private:
  enum class Start { as_placed, closed, in_situ_stress };
  Start start_ = Start::as_placed;
  double distance_ = 0;  // [m] 0: automatic
  int array_ = -1;
};

/// Statistics of a contact's points in the state in which it first acts.
struct FirstTouch {
  double points = 0, closed = 0;  // counts
  double deep = 0;                // points that lie deeper in the body than the closing distance
  double pulled = 0, beyond = 0;  // where the soil's stress is tension; where it is more than the normal law gives
  double least_gap = 0, largest_gap = 0, deepest = 0;   // [m] of those closed; of those deep
  double reach = 0;                                     // [m] the largest closing distance
  double least_pressure = 1e300, largest_pressure = 0;  // [Pa] of those closed
  void close(double gap, double pressure);
  /// The statistics over all ranks. Collective.
  FirstTouch everywhere(const Comm& comm) const;
  /// Writes them to the log.
  void tell(const std::string& contact, bool pressed) const;
};

}  // namespace mudline
