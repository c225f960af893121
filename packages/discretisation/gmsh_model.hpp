#pragma once

#include "discretisation/tagged_mesh.hpp"

namespace mudline {

/// The mesh of the model that Gmsh has open, of the given dimension (2 or 3). Entities are in the order of their
/// numbers. In a partitioned model the pieces of an entity belong to its groups; interface entities between the pieces,
/// and copies of elements for neighbouring pieces (ghosts), are left out. Throws InputError without a position.
TaggedMesh read_gmsh_model(int dimension);

}  // namespace mudline
