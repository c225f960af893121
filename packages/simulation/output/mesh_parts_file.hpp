#pragma once

#include <memory>
#include <string>

#include "discretisation/mesh.hpp"

namespace mudline {

/// Size and balance of the parts of a mesh.
struct MeshPartsReport {
  long long elements = 0, nodes = 0;
  double element_share = 0, node_share = 0;  // largest over mean: elements, owned nodes
};

/// Makes the mesh and writes its parts for `ranks` ranks to one HDF5 file, a group each, with the deck entries and the
/// fingerprints of the files from which it was made. docs/output_format.md has the layout. InputError for a wrong mesh,
/// RunError when the file cannot be written. To be called by one process alone.
MeshPartsReport write_mesh_parts(const MeshRecipe& recipe, int ranks, const std::string& path);

/// Reads this rank's part; no rank sees more of the mesh. InputError on every rank alike when the file is missing or
/// damaged, was cut for another number of ranks, or from another mesh than the recipe's. Collective.
std::unique_ptr<Mesh> read_mesh_parts(const Teuchos::RCP<const Teuchos::Comm<int>>& comm, const MeshRecipe& recipe,
                                      const std::string& path);

}  // namespace mudline
