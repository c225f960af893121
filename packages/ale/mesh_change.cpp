#include "ale/mesh_change.hpp"

#include "ale/ale.hpp"

namespace mudline {

namespace {

/// In the numbers of the whole mesh.
NodalRemap::Bounded bounded(const Ale& ale, const GhostedMesh& whole, const Positions& x) {
  NodalRemap::Bounded result{whole, ale.paths(), ale.surfaces().faces, x};
  const auto number = [&](int& node) { node = static_cast<int>(ale.mesh().node_id(node)); };
  for (MeshPath& path : result.paths)
    for (int& node : path.nodes) number(node);
  for (SurfaceFace& face : result.faces)
    for (int a = 0; a < num_nodes(face.shape); ++a) number(face.nodes[a]);
  return result;
}

}  // namespace

MeshChange::MeshChange(const Ale& from, const State& before, const Ale& to, const State& after)
    : from_(from.mesh().mesh()),
      to_(to.mesh().mesh()),
      x_from_(from_.gather(before.coordinates)),
      x_to_(to_.gather(after.coordinates)),
      nodal_(bounded(from, from_, x_from_), bounded(to, to_, x_to_)) {}

void MeshChange::carry(const Space& old_space, int old_field, const ConstNodalView& old, const Space& space, int field,
                       const NodalView& now, bool limited) const {
  const Field& what = space.field(field);
  to_.scatter(space, field,
              nodal_.apply(from_.gather(old_space, old_field, old), what.components, what.support, limited), now);
}

}  // namespace mudline
