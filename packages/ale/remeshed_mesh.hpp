#pragma once

#include <Teuchos_Comm.hpp>

#include <array>
#include <vector>

#include "ale/mesh_paths.hpp"
#include "discretisation/mesh.hpp"

namespace mudline {

/// What the sides of a path were in the deck's mesh, and are to be again: the (vertex) share of the path's measure,
/// and its total.
struct PathOrigin {
  std::vector<double> shares;
  double total = 0;
};

/// A face of a boundary in space, by its corners in ascending order, and the patch that it belongs to.
struct FaceOfPatch {
  std::array<long long, 3> corners;
  int patch;
};

/// How long edges of a boundary in space are to be at a vertex, see BoundaryMotion::relative_sizes().
struct RelativeSize {
  long long node;
  double size;
};

/// A mesh that was made on the way, with all that a model on it must know, so that a run goes on from it as from a
/// deck's mesh.
struct RemeshedMesh {
  int number = 0;                   // how many such meshes there have been, itself among them
  int step = 0;                     // after which it was made
  GlobalMesh mesh;                  // on rank 0, and empty elsewhere
  std::vector<MeshPath> paths;      // of its own nodes, in the order of those of the mesh before
  std::vector<PathOrigin> origins;  // (path)
  Point focus{};                    // of the sizes, when it was made [m]
  // In space:
  std::vector<FaceOfPatch> faces;
  std::vector<RelativeSize> sizes;

  std::vector<char> bytes() const;
  static RemeshedMesh from_bytes(std::vector<char> bytes);
};

/// What rank 0 has, on every rank, the mesh itself on rank 0 alone. Collective.
RemeshedMesh broadcast(const Teuchos::Comm<int>& comm, RemeshedMesh made);

}  // namespace mudline
