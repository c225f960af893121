#include "ale/mesh_change.hpp"

#include "ale/ale.hpp"

namespace mudline {

namespace {

/// In the numbers of the whole mesh.
std::vector<MeshPath> whole_paths(const Ale& ale) {
  std::vector<MeshPath> paths = ale.paths();
  for (MeshPath& path : paths)
    for (int& node : path.nodes) node = static_cast<int>(ale.mesh().node_id(node));
  return paths;
}

}  // namespace

MeshChange::MeshChange(const Ale& from, const State& before, const Ale& to, const State& after)
    : from_(from.mesh().mesh()),
      to_(to.mesh().mesh()),
      x_from_(from_.gather(before.coordinates)),
      x_to_(to_.gather(after.coordinates)),
      nodal_(from_, whole_paths(from), x_from_, to_, whole_paths(to), x_to_) {}

void MeshChange::carry(const Space& old_space, int old_field, const ConstNodalView& old, const Space& space, int field,
                       const NodalView& now, bool limited) const {
  const Field& what = space.field(field);
  to_.scatter(space, field,
              nodal_.apply(from_.gather(old_space, old_field, old), what.components, what.support, limited), now);
}

}  // namespace mudline
