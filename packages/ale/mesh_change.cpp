#include "ale/mesh_change.hpp"

#include "ale/ale.hpp"

namespace mudline {

namespace {

/// Boxes around this rank's own elements, a few neighbours in each.
std::vector<Bounds> boxes(const GhostedMesh& mesh, const Positions& x) {
  constexpr std::size_t together = 16;
  std::vector<Bounds> result;
  for (std::size_t block = 0; block < mesh.mesh().blocks().size(); ++block) {
    const std::vector<int>& own = mesh.own_elements(static_cast<int>(block));
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (k % together == 0) result.push_back(Bounds::nothing());
      enclose(result.back(), mesh.elements()[own[k]], x);
    }
  }
  return result;
}

/// Paths and faces of `ale` in the node numbers of `mesh`, another view of its mesh.
NodalRemap::Bounded bounded(const Ale& ale, const GhostedMesh& mesh, const Positions& x) {
  NodalRemap::Bounded result{mesh, ale.paths(), ale.surfaces().faces, x};
  const auto number = [&](int& node) { node = mesh.local_node(ale.mesh().node_id(node)); };
  for (MeshPath& path : result.paths)
    for (int& node : path.nodes) number(node);
  for (SurfaceFace& face : result.faces)
    for (int a = 0; a < num_nodes(face.shape); ++a) number(face.nodes[a]);
  return result;
}

GhostedMesh near_to(const Ale& from, const State& before, const std::vector<Bounds>& boxes) {
  const GhostedMesh::Wanted near{before.coordinates, boxes};
  return GhostedMesh(from.mesh().mesh(), from.mesh().layers(), &near);
}

}  // namespace

MeshChange::MeshChange(const Ale& from, const State& before, const Ale& to, const State& after)
    : old_space_(from.space()),
      space_(to.space()),
      to_(to.mesh()),
      x_to_(to_.gather(after.coordinates)),
      from_(near_to(from, before, boxes(to_, x_to_))),
      x_from_(from_.gather(before.coordinates)),
      nodal_(bounded(from, from_, x_from_), {to_, to.paths(), to.surfaces().faces, x_to_}) {}

void MeshChange::transfer(int field, const ConstNodalView& old, const NodalView& now, bool limited) const {
  const Field& what = space_.field(field);
  to_.scatter(space_, field, nodal_.apply(from_.gather(old_space_, field, old), what.components, what.support, limited),
              now);
}

}  // namespace mudline
