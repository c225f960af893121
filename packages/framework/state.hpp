#pragma once

#include <Kokkos_Core.hpp>

#include <memory>
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
  Increment increment;                  // stage and number of the next increment
  NodalView value, rate, acceleration;  // by overlap dof; the acceleration of first-order fields is unused
  /// Rates at the end of the last step, with which the first guess of a step without inertia goes on. Where the mesh
  /// moves they stay with the nodes: soil flows past a body, and nodes that go along with it see the same flow again.
  NodalView predictor;
  std::vector<NodalView> history_forces;  // F_n of each history term: this rank's contributions, by overlap dof
  CoordinateView coordinates;             // (node, dimension) [m] current
  std::vector<PointView> arrays;          // declared by terms: point state, contact history
};

class SurfacePoints;

/// Description of one declared array: what its rows belong to and how its variables are transferred. Mesh motion,
/// remeshing, checkpoint and output read it, so that whoever declares an array does nothing for these.
///
/// Rows at points, on surfaces and at nodes have places. On another mesh each variable follows its rule (see Transfer)
/// within its bounds. Where the mesh moves, a row keeps its part of a total, and the nearest row is looked for among
/// those of the same element, side, or element around the node. `mass` is for rows at points. A total at nodes stays
/// with its nodes, so that a remeshing that would move one of them is refused. Rows without a place are copied.
struct ArrayInfo {
  enum class On {
    model,    // the rows belong to no place and are the same on all ranks
    sum,      // one row of sums over the mesh, of which every rank has its share
    points,   // quadrature points of an element block, element after element
    surface,  // points on the sides of a side set, see SurfacePoints
    nodes     // nodes that this rank owns, of a set or of the whole mesh
  };
  std::string name;                      // "soil/effective stress", "contact/cone/points"
  std::vector<StateVariable> variables;  // split of the columns
  On on = On::model;
  int rows = 1;                                       // on this rank
  int block = -1, points_per_element = 0;             // of points
  std::shared_ptr<const SurfacePoints> surface = {};  // of a surface
  std::vector<int> nodes = {};                        // local numbers, by row
  /// Ids of the rows, independent of the number of ranks, for a restart on another number of them. Empty for points and
  /// sums; the rows of a model may go without.
  std::vector<long long> ids = {};
  /// Id of the row that takes the sum of the rows that a restart no longer has; rows that are new start with 0. -1: a
  /// restart has the same rows.
  long long rest = -1;
  /// After a transfer the array takes what its terms write when the state is evaluated at rest: stresses returned to
  /// the yield surface, gaps.
  bool evaluated = false;
  bool hidden = false;  // it is not written to the results: their author writes it in another form, or not at all

  static ArrayInfo of_model(std::string name, std::vector<StateVariable> variables, int rows = 1);
  /// With a row for each of the ids.
  static ArrayInfo of_model(std::string name, std::vector<StateVariable> variables, std::vector<long long> ids);
  static ArrayInfo of_sum(std::string name, std::vector<StateVariable> variables);
  static ArrayInfo at_points(std::string name, std::vector<StateVariable> variables, const Mesh& mesh, int block,
                             int points_per_element);
  static ArrayInfo on_surface(std::string name, std::vector<StateVariable> variables,
                              std::shared_ptr<const SurfacePoints> points);
  /// `set`: name of a side or node set; "": all nodes.
  static ArrayInfo at_nodes(std::string name, std::vector<StateVariable> variables, const Mesh& mesh,
                            const std::string& set = "");
  /// The same array with the flag `evaluated` or `hidden`.
  ArrayInfo&& then_evaluated() &&;
  ArrayInfo&& not_shown() &&;
  /// The same array, whose rows may be others in a restart, see `rest`.
  ArrayInfo&& rest_in(long long row) &&;

  int columns() const;
  /// Why this description contradicts itself; "": it does not.
  std::string problem() const;
};

/// Owns the committed and the trial state. begin() copies, accept() swaps; rejecting a step needs no call.
class StateStore {
 public:
  explicit StateStore(const Space& space);
  /// Adds an array to both states before the first step; returns its handle. std::logic_error if the name is already
  /// declared, or if the description contradicts itself.
  int declare(ArrayInfo info);
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
  /// Copies the arrays that are evaluated after a transfer from the trial state, an evaluation of the committed state
  /// at rest, to the committed one.
  void take_evaluated();

 private:
  std::vector<ArrayInfo> info_;
  State committed_, trial_, kept_;
};

}  // namespace mudline
