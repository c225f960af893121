#pragma once

#include <Teuchos_Comm.hpp>

#include <array>
#include <vector>

#include "ale/mesh_paths.hpp"
#include "discretisation/mesh.hpp"

namespace mudline {

/// Sides of a path in the deck's mesh, which remeshing reproduces: by vertex the share of the path's measure, and its
/// total, see CurveMeasure.
struct PathOrigin {
  std::vector<double> shares;
  double total = 0;
};

/// A face of a boundary in space, by its corners in ascending order, and the patch that it belongs to.
struct FaceOfPatch {
  std::array<long long, 3> corners;
  int patch;
};

/// Relative edge length at a vertex of a boundary in space, see BoundaryMotion::relative_sizes().
struct RelativeSize {
  long long node;
  double size;
};

/// A mesh from remeshing, with all that a model on it needs, so that a run continues on it as on a deck's mesh.
struct RemeshedMesh {
  int number = 0;                   // number of remeshings so far, this one included
  int step = 0;                     // step after which it was made
  GlobalMesh mesh;                  // on rank 0, and empty elsewhere
  std::vector<MeshPath> paths;      // of its own nodes, in the order of the old mesh's paths
  std::vector<PathOrigin> origins;  // (path)
  Point focus{};                    // position of the focus when it was made [m]
  // In space:
  std::vector<FaceOfPatch> faces;
  std::vector<RelativeSize> sizes;

  std::vector<char> bytes() const;
  static RemeshedMesh from_bytes(std::vector<char> bytes);
};

/// Broadcasts rank 0's result to all ranks; the mesh itself stays on rank 0 alone. Collective.
RemeshedMesh broadcast(const Teuchos::Comm<int>& comm, RemeshedMesh made);

}  // namespace mudline
