#pragma once

#include <array>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "ale/mesh_paths.hpp"

namespace mudline {

/// A face of the boundary of a region in space.
struct SurfaceFace : CurvedSide {  // as seen from outside `block`
  std::set<std::string> sets;      // side sets that it belongs to
  bool outer = true;               // on the boundary of the mesh, not between two regions
  int block = 0, other = -1;       // regions on its two sides, the lower first; -1: none
  int patch = -1;                  // number of the patch that it belongs to; -1: not known yet
};

/// Faces that are smoothly joined: nodes inside the patch may slide on them.
struct SurfacePatch {
  std::vector<int> faces;
  std::set<std::string> sets;  // side sets that all its faces belong to
  bool outer = true;
  bool material = false;  // its nodes stay material points; see BoundaryMotion
};

/// The simplex at a corner of an element whose vertices are all on boundaries of regions, so that no inner vertex can
/// keep it from folding. It is not folded where its edges from the first node to the second, third and fourth are
/// right-handed. See CornerSimplices.
struct BoundarySimplex {
  std::array<int, 4> nodes;
  /// Mid-side nodes of the edges from the first node, whose tangents count in place of their ends; -1: the end counts.
  std::array<int, 4> mid_side_nodes;
};

/// The boundaries of the regions of a mesh. In space they are split into patches where they have edges; a node is
/// inside one patch, or on feature curves. In the plane there are curves alone. The ends of curves are material points.
struct MeshSurfaces {
  std::vector<SurfaceFace> faces;
  std::vector<SurfacePatch> patches;
  std::vector<MeshPath> curves;
  std::vector<int> patch_of;  // (node) the patch that it is inside; -1: none
};

/// (node) whether a remeshing leaves it where it is: an end of a curve, a corner inside a patch, or a node of a
/// material curve or patch. `nodes`: number of nodes of the mesh.
std::vector<char> fixed_nodes(const MeshSurfaces& boundary, std::size_t nodes);

/// The faces of the boundaries of all regions.
std::vector<SurfaceFace> boundary_faces(const GhostedMesh& mesh);

/// Surfaces of faces whose patches are known. `nodes`: number of nodes of the mesh; `corners`: see split_surfaces().
MeshSurfaces joined_surfaces(std::vector<SurfaceFace> faces, std::vector<MeshPath> curves, std::size_t nodes,
                             const std::set<int>& corners);

/// Splits faces into patches. Two neighbours belong to different patches where more than two faces meet, where the side
/// sets or the regions beside them change, and where their normals in the source's mesh differ by more than
/// `corner_angle` [rad] at the middle of the edge, unless that lies on a body (`on_body` of a node): the soil slides
/// past an edge of the body. The edges between patches form curves, which end where more or fewer than two meet, at the
/// nodes `corners` and where they turn by more than the angle off a body. A curve has the side sets of all faces beside
/// it. `corners` inside patches are material points as well.
MeshSurfaces split_surfaces(std::vector<SurfaceFace> faces, const Positions& source, const std::set<int>& corners,
                            double corner_angle, const std::function<bool(int node)>& on_body);

}  // namespace mudline
