#pragma once

#include "discretisation/gmsh_file.hpp"
#include "discretisation/source_position.hpp"
#include "discretisation/tagged_mesh.hpp"

namespace mudline {

/// Reads a mesh file or meshes a geometry, in a process of its own. `dimension`: 2 or 3; `order`: of the elements that
/// are made. Entities are in the order of their numbers. In a partitioned model the pieces of an entity belong to its
/// groups; interface entities between the pieces, and copies of elements for neighbouring pieces (ghosts), are left
/// out. Throws InputError.
TaggedMesh read_gmsh_mesh(const GmshFile& file, int dimension, int order, const SourcePosition& position);

}  // namespace mudline
