#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ale/boundary_motion.hpp"
#include "ale/interior_motion.hpp"
#include "ale/mesh_transfer.hpp"
#include "ale/remesher.hpp"
#include "ale/vertex_colours.hpp"
#include "physics/inventory.hpp"

namespace mudline {

/// The registries that the deck's "mesh motion" needs.
struct MeshMotionRegistries {
  const Registry<InteriorMotion>& motions;
  const Registry<Remap>& remaps;
};

/// Parameters of the deck's "mesh motion", without those of its interior motion and remap.
struct AleParameters {
  void parameters(Parameters& p);
  int every = 1;
  double quality_below = 2, lowest_quality = 0.05, mass_tolerance = 1e-3, largest_motion = 1;
  bool conserve = true;
  BoundaryMotion boundary;
  RemeshingParameters remeshing;
};

/// Result of a relocation of the mesh, also of one that was vetoed.
struct MeshReceipt {
  bool moved = false;
  std::string veto;                        // why it was not made; empty: it was
  double quality_before = 1, quality = 1;  // smallest scaled Jacobian [-]
  double largest_motion = 0;               // [-] of the element's size: Courant number
  double restored_solid = 0;               // share of the grains that the transfer lost and conservation put back [-]
  std::vector<double> restored_grains;     // [kg] of each material, by Soil::materials
  std::vector<double> unresolved_grains;   // [kg] of each material that points of cut elements seem to have lost
  int changed = 0, started = 0;            // points with another material than before, and those whose law started anew
  std::string started_where;               // one of the points whose law started anew, and its material
  double yield_drift = 0;        // [-] share of the stress that the laws corrected afterwards, see yield_drift()
  Inventory before, after;       // after: with the unresolved grains
  double unresolved_volume = 0;  // [m3] of the unresolved grains of all materials
};

/// A new mesh, or why there is none.
struct Remeshing {
  std::shared_ptr<const RemeshedMesh> mesh;
  std::string veto;
  std::string lost;  // why the mesher failed without an answer: the run must not go on with the old mesh
};

/// Relocation of the mesh under a committed state (arbitrary Lagrangian-Eulerian, operator split): boundary nodes slide
/// along the deformed boundary, the interior follows, state variables and nodal fields are transferred; the topology
/// does not change. A relocation is a transaction: a vetoed one leaves the state untouched.
class Ale {
 public:
  /// Reads "mesh motion". `remeshed`: the mesh of the space where a remeshing made it; null: it is the deck's.
  /// InputError. Collective.
  Ale(const Space& space, const Soil& soil, const std::map<std::string, std::shared_ptr<RigidBody>>& bodies,
      const Section& section, const MeshMotionRegistries& registries, const RemeshedMesh* remeshed);
  static void document(Parameters& p);
  /// Why an array of the state cannot be transferred; "": all can. Collective.
  std::string problem(const StateStore& store) const;

  /// Whether the mesh is to be moved after step number `step`, given its quality. Collective.
  bool due(int step, const State& committed) const;
  /// Moves mesh and state. The caller evaluates the state anew and then calls StateStore::take_evaluated.
  /// `constraints`: those of the step that ended. Collective.
  MeshReceipt relocate(StateStore& store, const Constraints& constraints) const;
  /// Smallest scaled Jacobian of the mesh. Collective.
  double quality(const State& state) const;

  /// The remesher of the region; null: the deck has no remeshing.
  const Remesher* remeshing() const { return remesher_.get(); }
  /// Number of remeshings so far.
  int remeshings() const { return remeshings_; }
  /// Whether the region is to be remeshed after step number `step`. `tried`: step of the last attempt. Collective.
  bool remeshing_due(int step, int tried, const State& committed) const;
  /// Whether the error estimate is to be evaluated after step number `step`, to decide on remeshing.
  bool looks_at_error(int step, int tried) const;
  /// Field of the element sizes that an error estimate asks for. `by_element`: [m] for this rank's elements, block of
  /// the soil after block. The result is on rank 0, where meshes are made; null elsewhere. Collective.
  std::unique_ptr<const WantedSizes> wanted_sizes(const std::vector<double>& by_element, const State& committed) const;
  /// Whether elements are so much larger than wanted that the region is to be remeshed. Collective.
  bool too_coarse(const WantedSizes* sizes) const;
  /// A new mesh for the committed state; its elements are on rank 0 alone. `sizes`: from wanted_sizes() where sizes are
  /// adaptive, else null. Collective.
  Remeshing remesh(int step, const State& committed, const WantedSizes* sizes) const;
  /// Moves the free boundary of a new mesh until the soil has the volume that it has in state `before` on the old mesh,
  /// that of `from`. `constraints`: those of the present instant, on the new mesh. Collective.
  void match_volume(const Ale& from, const State& before, const Constraints& constraints, State& to) const;
  /// Transfers the state from `from` to `store`, after match_volume(); `store` must hold the bodies' state and the
  /// arrays without places already. It is then evaluated as after relocate(). Collective.
  MeshReceipt transfer_from(const Ale& from, const StateStore& old_store, const MeshTransfer& transfer,
                            const Constraints& constraints, StateStore& store) const;
  const Space& space() const { return space_; }
  const Soil& soil() const { return soil_; }
  /// This rank's part of the mesh, with ghosts. The paths are those of the whole mesh.
  const GhostedMesh& mesh() const { return mesh_; }
  const std::vector<MeshPath>& paths() const { return deck_.boundary.paths(); }
  /// Boundary surfaces of the whole mesh; empty in the plane.
  const MeshSurfaces& surfaces() const { return deck_.boundary.parts(); }
  const SurfaceMotion& surface_motion() const { return deck_.boundary.surfaces(); }
  /// Remap of point data to the moved mesh, and the patches of a block of the soil for it.
  const Remap& remap() const { return *remap_; }
  const RecoveryPatches& patches(std::size_t block) const { return patches_[block]; }
  /// Whether a transfer restores what it changed in grains, water and momentum.
  bool conserves() const { return deck_.conserve; }

 private:
  /// New positions of all nodes; a reason when there are none.
  std::string new_positions(const Positions& x_old, const State& state, const Constraints& constraints,
                            Positions& x) const;
  /// (node, component) 1 where a field's value is prescribed.
  std::vector<double> prescribed(int field, const Constraints& constraints) const;
  /// Moves the free boundary until the soil has this volume [m3].
  void keep_volume(double volume, const State& state, const Constraints& constraints, Positions& x) const;
  double largest_motion(const Positions& x_old, const Positions& x_new) const;
  bool folded(const Positions& x) const;
  /// Puts mid-side nodes and centres that are not on a boundary in the middle of the nodes around them.
  void place_mid_side_nodes(Positions& x) const;
  /// Why a point array or a law has variables that cannot be transferred in a block; "": it has none.
  std::string problem_at_points(const StateStore& store, int handle) const;
  /// Scales the free pore pressures until the compression of the pore water [m3] is `before`.
  void keep_compression(double before, const Constraints& constraints, State& to) const;
  /// Sets the receipt's inventory after a transfer, with the grains that the points of cut elements do not resolve.
  void take_stock(const State& state, MeshReceipt& receipt) const;
  /// Why a transfer must be vetoed for the mass that it changed; "": it is conserved within the tolerance.
  std::string lost_mass(const MeshReceipt& receipt) const;
  void keep_momentum(const Inventory& before, const Constraints& constraints, State& to) const;

  AleParameters deck_;
  const Space& space_;
  const Soil& soil_;
  GhostedMesh mesh_;
  std::vector<RecoveryPatches> patches_;  // (block)
  Positions source_;                      // nodes of the source's mesh, then the ends of their tangents
  CornerSimplices corners_;
  std::unique_ptr<InteriorMotion> interior_;
  std::unique_ptr<Remap> remap_;
  std::unique_ptr<Remesher> remesher_;
  int remeshings_ = 0, remeshed_after_ = 0;  // number of remeshings, step of the last one
  std::vector<char> movable_;                // (node)
  std::vector<std::vector<int>> colours_;    // of this rank's movable vertices
};

}  // namespace mudline
