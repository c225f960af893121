#pragma once

#include <memory>
#include <string>

#include "discretisation/mesh.hpp"

namespace mudline {

/// What the parts of a mesh are like.
struct MeshPartsReport {
  long long elements = 0, nodes = 0;
  double element_share = 0, node_share = 0;  // largest over mean: elements, owned nodes
};

/// Makes the mesh and writes its parts for so many ranks to one HDF5 file, a group each, with the entries and the
/// fingerprints of the files that it was made from. docs/output_format.md has the layout. InputError for what is wrong
/// with the mesh, RunError when the file cannot be written. For one process alone.
MeshPartsReport write_mesh_parts(const MeshRecipe& recipe, int ranks, const std::string& path);

/// This rank's part: no rank sees more of the mesh. InputError on every rank alike when the file is missing or damaged,
/// was cut for another number of ranks, or from another mesh than the recipe's. Collective.
std::unique_ptr<Mesh> read_mesh_parts(const Teuchos::RCP<const Teuchos::Comm<int>>& comm, const MeshRecipe& recipe,
                                      const std::string& path);

}  // namespace mudline
