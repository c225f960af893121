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

/// Position of a node [m]; in the plane the third component is 0.
inline Point place_of(const ConstCoordinateView& x, int node) {
  Point result{};
  for (std::size_t i = 0; i < x.extent(1); ++i) result[i] = x(node, i);
  return result;
}

/// Everything that an exact restart needs. Two instances live in a StateStore: committed and trial.
struct State {
  double time = 0;
  Increment increment;                    // stage and number of the next increment
  NodalView value, rate, acceleration;    // by overlap dof; the acceleration of first-order fields is unused
  std::vector<NodalView> history_forces;  // F_n of each history term: this rank's contributions, by overlap dof
  CoordinateView coordinates;             // (node, dimension) [m] current
  std::vector<PointView> arrays;          // declared by terms: point state, contact history
};

/// Description of one declared array, for output, checkpoint and transfer.
struct ArrayInfo {
  std::string name;                      // "soil/effective stress", "contact/cone/active"
  std::vector<StateVariable> variables;  // split of the columns
  int block = -1;                        // element block whose points are the rows; -1: not point data
  int points_per_element = 0;
  /// Ids of the rows, independent of the number of ranks, for a restart on another number of them. Empty: the rows are
  /// the points of `block` or, without a block, rows that every rank has alike.
  std::vector<long long> ids = {};
  bool shares = false;  // rows of the same id on several ranks are added up
};

/// Owns the committed and the trial state. begin() copies, accept() swaps; rejecting a step needs no call.
class StateStore {
 public:
  explicit StateStore(const Space& space);
  /// Adds an array of `rows` rows to both states before the first step; returns its handle. std::logic_error if the
  /// name is already declared.
  int declare(ArrayInfo info, int rows);
  int find(const std::string& name) const;  // handle or -1
  int num_arrays() const { return static_cast<int>(info_.size()); }
  const ArrayInfo& info(int handle) const { return info_[handle]; }

  State& committed() { return committed_; }
  const State& committed() const { return committed_; }
  State& trial() { return trial_; }
  const State& trial() const { return trial_; }

  /// Makes room for F_n of this many history terms.
  void allocate_history(int terms);

  /// trial = committed (deep copy).
  void begin();
  /// The trial state becomes the committed one.
  void accept();
  /// keep() saves a copy of the committed state and restore() makes it the committed one again, for steps that may be
  /// refused after acceptance.
  void keep();
  void restore();

 private:
  std::vector<ArrayInfo> info_;
  State committed_, trial_, kept_;
};

}  // namespace mudline
