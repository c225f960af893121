#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ale/boundary_motion.hpp"
#include "ale/interior_motion.hpp"
#include "ale/layer_remap.hpp"
#include "ale/mesh_change.hpp"
#include "ale/nodal_remap.hpp"
#include "ale/remap.hpp"
#include "ale/remesher.hpp"
#include "ale/vertex_colours.hpp"
#include "physics/inventory.hpp"

namespace mudline {

/// The registries that the deck's "mesh motion" needs.
struct MeshMotionRegistries {
  const Registry<InteriorMotion>& motions;
  const Registry<Remap>& remaps;
};

/// What the deck says of mesh motion, besides its parts.
struct AleParameters {
  void parameters(Parameters& p);
  int every = 1;
  double quality_below = 2, lowest_quality = 0.05, mass_tolerance = 1e-3, largest_motion = 1;
  bool conserve = true;
  BoundaryMotion boundary;
  RemeshingParameters remeshing;
};

/// What a relocation of the mesh did, or would have done.
struct MeshReceipt {
  bool moved = false;
  std::string veto;                        // why it was not made; empty: it was
  double quality_before = 1, quality = 1;  // smallest scaled Jacobian [-]
  double largest_motion = 0;               // [-] of the element's size: Courant number
  double restored_solid = 0;               // share of the grains that the transfer lost and conservation put back [-]
  std::vector<double> restored_grains;     // [kg] of each material, by Soil::materials
  std::vector<double> unresolved_grains;   // [kg] of each material that points of cut elements seem to have lost
  int changed = 0, started = 0;            // points with another material than before, and those whose law started anew
  std::string started_where;               // one of the latter, and its material
  double yield_drift = 0;        // [-] share of the stress that the laws took back to their yield surfaces afterwards
  Inventory before, after;       // after: with the unresolved grains
  double unresolved_volume = 0;  // [m3] of the unresolved grains of all materials
};

/// A mesh made anew, or why there is none.
struct Remeshing {
  std::shared_ptr<const RemeshedMesh> mesh;
  std::string veto;
  std::string lost;  // why nobody knows whether there is one: the run must not go on with another mesh
};

/// Relocation of the mesh under a committed state (arbitrary Lagrangian-Eulerian, operator split): boundary nodes slide
/// along the deformed boundary, the interior follows, state variables and nodal fields are carried over; the topology
/// is kept. A transaction of its own: a vetoed relocation leaves the state untouched.
class Ale {
 public:
  /// Reads "mesh motion". `remeshed`: the mesh of the space, where it is not the deck's. InputError. Collective.
  Ale(const Space& space, const Soil& soil, const std::map<std::string, std::shared_ptr<RigidBody>>& bodies,
      const Section& section, const MeshMotionRegistries& registries, const RemeshedMesh* remeshed);
  static void document(Parameters& p);
  /// Why point data that a term declared cannot be carried along; "": they can.
  std::string problem(const StateStore& store) const;

  /// Whether the mesh is to be moved after step number `step`, given its quality. Collective.
  bool due(int step, const State& committed) const;
  /// Moves mesh and soil state. The caller lets the terms follow (Term::relocate), evaluates the state anew and lets it
  /// be taken over (Term::adopt). `constraints`: those of the step that ended. Collective.
  MeshReceipt relocate(StateStore& store, const Constraints& constraints) const;
  /// Smallest scaled Jacobian of the mesh. Collective.
  double quality(const State& state) const;

  /// How the region is meshed anew; null: it is not.
  const Remesher* remeshing() const { return remesher_.get(); }
  /// Meshes that were made on the way so far.
  int remeshings() const { return remeshings_; }
  /// Whether the region is to be meshed anew after step number `step`, where the last attempt was after `tried`.
  /// Collective.
  bool remeshing_due(int step, int tried, const State& committed) const;
  /// Whether it is time to ask an error estimate whether that is due.
  bool looks_at_error(int step, int tried) const;
  /// The field of the sizes that an error estimate wants, [m] by element of this rank, block of the soil after block.
  /// On rank 0, where meshes are made; null elsewhere. Collective.
  std::unique_ptr<const WantedSizes> wanted_sizes(const std::vector<double>& by_element, const State& committed) const;
  /// Whether elements are so much larger than wanted that the region is to be meshed anew. Collective.
  bool too_coarse(const WantedSizes* sizes) const;
  /// A new mesh for the committed state; its elements on rank 0 alone. `sizes`: where they are adaptive, else null.
  /// Collective.
  Remeshing remesh(int step, const State& committed, const WantedSizes* sizes) const;
  /// Lets the free boundary of a mesh made anew give way until it holds the volume that `from`, an ALE of the mesh
  /// before, has in `before`. `constraints`: those of the present instant, on the new mesh. Collective.
  void take_volume(const Ale& from, const State& before, const Constraints& constraints, State& to) const;
  /// Then the soil's state of `from` goes over to this one's `store`, whose bodies have theirs already; the terms then
  /// follow as after relocate(). Collective.
  MeshReceipt take_over(const Ale& from, const StateStore& old_store, const MeshChange& change,
                        const Constraints& constraints, StateStore& store) const;
  const Space& space() const { return space_; }
  /// The mesh about this rank, and the paths of the whole one.
  const GhostedMesh& mesh() const { return mesh_; }
  const std::vector<MeshPath>& paths() const { return deck_.boundary.paths(); }
  /// In space, likewise.
  const MeshSurfaces& surfaces() const { return deck_.boundary.surfaces().surfaces(); }

 private:
  /// New positions of all nodes; a reason when there are none.
  std::string new_positions(const Positions& x_old, const State& state, const Constraints& constraints,
                            Positions& x) const;
  /// (node, component) 1 where a field's value is prescribed.
  std::vector<double> prescribed(int field, const Constraints& constraints) const;
  /// Lets the free boundary give way until the soil has this volume [m3].
  void keep_volume(double volume, const State& state, const Constraints& constraints, Positions& x) const;
  double largest_motion(const Positions& x_old, const Positions& x_new) const;
  bool folded(const Positions& x) const;
  /// Of the sides inside.
  void place_mid_side_nodes(Positions& x) const;
  struct Transferring {
    const Remap& remap;
    const RecoveryPatches& patches;  // of the mesh before
  };
  /// All point data of one block, from the state of one store to that of another or of the same one. Adds what it did
  /// to the receipt, veto among it.
  void transfer_block(const BlockPoints& before, const StateStore& old_store, const State& old_state,
                      const BlockPoints& after, const StateStore& store, const State& to, const Transferring& how,
                      MeshReceipt& receipt) const;
  /// Adds what it did to the receipt.
  void transfer_points(const StateStore& store, const Positions& x_old, const Positions& x_new, State& to,
                       MeshReceipt& receipt) const;
  /// What the columns of all of a block's point data in one table are, in the order of their handles.
  SoilTable table_of(const StateStore& store, const SoilBlock& block) const;
  /// Puts the grains back that a transfer lost.
  void conserve_grains(const PointTransfer& transfer, const SoilTable& table, const LayerRatios& ratios,
                       MeshReceipt& receipt) const;
  /// Scales the pore pressures, where they are free, until the compression of the pore water is what it was.
  void keep_compression(double before, const Constraints& constraints, State& to) const;
  void transfer_nodes(const Positions& x_old, const Positions& x_new, State& to) const;
  /// What the soil holds in a state after a transfer, with what the points of cut elements do not resolve.
  void take_stock(const State& state, MeshReceipt& receipt) const;
  /// Why a receipt's masses are not what they were, "" where they are.
  std::string lost_mass(const MeshReceipt& receipt) const;
  // To another mesh: see take_over().
  void take_nodes(const State& old_state, const MeshChange& change, State& to) const;
  void take_points(const Ale& from, const StateStore& old_store, const MeshChange& change, StateStore& store,
                   MeshReceipt& receipt) const;
  void keep_momentum(const Inventory& before, const Constraints& constraints, State& to) const;

  AleParameters deck_;
  const Space& space_;
  const Soil& soil_;
  GhostedMesh mesh_;
  std::vector<RecoveryPatches> patches_;  // (block)
  Positions source_;                      // and the ends of its tangents
  CornerSimplices corners_;
  std::unique_ptr<InteriorMotion> interior_;
  std::unique_ptr<Remap> remap_;
  std::unique_ptr<Remesher> remesher_;
  int remeshings_ = 0, remeshed_after_ = 0;  // meshes made on the way, step of the last one
  std::vector<char> movable_;                // (node)
  std::vector<std::vector<int>> colours_;    // of this rank's movable vertices
};

}  // namespace mudline
