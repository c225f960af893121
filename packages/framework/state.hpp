#pragma once

#include <Kokkos_Core.hpp>

#include <string>
#include <vector>

#include "framework/space.hpp"
#include "materials/skeleton.hpp"

namespace mudline {

using NodalView = Kokkos::View<double*>;  // by overlap dof
using ConstNodalView = Kokkos::View<const double*>;
using CoordinateView = Kokkos::View<double**, Kokkos::LayoutRight>;  // (node, dimension) [m]
using ConstCoordinateView = Kokkos::View<const double**, Kokkos::LayoutRight>;

/// Where a node is [m]; in the plane the third number is 0.
inline Point place_of(const ConstCoordinateView& x, int node) {
  Point result{};
  for (std::size_t i = 0; i < x.extent(1); ++i) result[i] = x(node, i);
  return result;
}

/// Everything that makes a restart exact. Two instances live in a StateStore: committed and trial.
struct State {
  double time = 0;
  Increment increment;                    // that comes next
  NodalView value, rate, acceleration;    // by overlap dof; the acceleration of first-order fields is unused
  std::vector<NodalView> history_forces;  // F_n of each history term: this rank's contributions, by overlap dof
  CoordinateView coordinates;             // (node, dimension) [m] current
  std::vector<PointView> arrays;          // declared by terms: point state, contact history
};

/// What one declared array is, for output, checkpoint and remap.
struct ArrayInfo {
  std::string name;                      // "soil/effective stress", "contact/cone/active"
  std::vector<StateVariable> variables;  // split of the columns
  int block = -1;                        // element block whose points are the rows; -1: not point data
  int points_per_element = 0;
  /// Of the rows, the same on any number of ranks, for a restart on another number. Empty: the points of `block`, or,
  /// without one, rows that every rank has alike.
  std::vector<long long> ids = {};
  bool shares = false;  // the ranks' rows of one id add up
};

/// Owns the committed and the trial state. begin copies, accept swaps, reject does nothing.
class StateStore {
 public:
  explicit StateStore(const Space& space);
  /// Before the first step: adds an array of `rows` rows to both states; returns its handle.
  int declare(ArrayInfo info, int rows);
  int find(const std::string& name) const;  // handle or -1
  int num_arrays() const { return static_cast<int>(info_.size()); }
  const ArrayInfo& info(int handle) const { return info_[handle]; }

  State& committed() { return committed_; }
  const State& committed() const { return committed_; }
  State& trial() { return trial_; }
  const State& trial() const { return trial_; }

  /// Room for F_n of this many history terms.
  void allocate_history(int terms);

  /// trial = committed (deep copy).
  void begin();
  /// The trial state becomes the committed one.
  void accept();
  /// Keeps a copy of the committed state, and makes it the committed one again: for what may be refused after
  /// acceptance.
  void keep();
  void restore();

 private:
  std::vector<ArrayInfo> info_;
  State committed_, trial_, kept_;
};

}  // namespace mudline
