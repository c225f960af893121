#pragma once

#include <memory>
#include <string>

#include "ale/layer_remap.hpp"
#include "ale/nodal_remap.hpp"
#include "ale/recovery.hpp"

namespace mudline {

class Ale;
struct MeshReceipt;

/// Transfer of a state to the same mesh after it has moved, or to another mesh of the same regions, with the same paths
/// in the same order: nodal fields, and all arrays by their descriptions. Besides its own elements of an old mesh a
/// rank has those that lie where it has elements of the new one.
class MeshTransfer {
 public:
  /// The nodes of a mesh were at `before` and are at `after`. The deck's remap transfers point data. Collective.
  MeshTransfer(const Ale& ale, const Positions& before, const Positions& after);
  /// From the mesh of `from` to that of `to`, in these states. Recovered fields are point data there. Collective.
  MeshTransfer(const Ale& from, const State& before, const Ale& to, const State& after);
  MeshTransfer(const MeshTransfer&) = delete;
  MeshTransfer& operator=(const MeshTransfer&) = delete;

  /// Transfers point data, nodal fields and arrays at nodes, on another mesh also arrays on surfaces, from one state to
  /// another or to the same one. Adds its result to the receipt, also a veto, after which the new state is undefined.
  /// Collective.
  void transfer(const StateStore& old_store, const State& old, const StateStore& store, const State& now,
                MeshReceipt& receipt) const;
  /// Transfers the nodal values of one field, by overlap dof, see NodalRemap. Collective.
  void transfer_field(int field, const ConstNodalView& old, const NodalView& now, bool limited = false) const;

  /// Copies the arrays whose rows have no places from one store's committed state to another's: those of the model, and
  /// sums, of which the first rank gets the whole. Returns the name of one that has other rows there, or "".
  /// Collective.
  static std::string copy_without_places(const StateStore& from, StateStore& to, const Comm& comm);
  /// Takes the arrays on surfaces to the moved mesh: the nodes were at x_old and are at the state's coordinates.
  static void follow_surfaces(const StateStore& store, const ConstCoordinateView& x_old, const State& state);

 private:
  bool moved() const { return &from_ == &to_; }
  /// All point data of one block.
  void transfer_block(std::size_t k, const StateStore& old_store, const State& old, const StateStore& store,
                      const State& now, MeshReceipt& receipt) const;
  /// Puts the grains back that a transfer lost.
  void conserve_grains(const PointTransfer& transfer, const SoilTable& table, const LayerRatios& ratios,
                       MeshReceipt& receipt) const;
  void transfer_node_arrays(const StateStore& old_store, const State& old, const StateStore& store,
                            const State& now) const;
  void transfer_surfaces(const StateStore& old_store, const State& old, const StateStore& store,
                         const State& now) const;

  const Ale &old_ale_, &ale_;
  const GhostedMesh& to_;
  const Positions x_to_;
  const std::unique_ptr<const GhostedMesh> near_;  // of another mesh, with the elements under this rank's new ones
  const GhostedMesh& from_;
  const Positions x_from_;
  const NodalRemap nodal_;
  const RecoveryRemap recovery_;
};

}  // namespace mudline
