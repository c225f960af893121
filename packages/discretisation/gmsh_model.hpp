#pragma once

#include "discretisation/mesh.hpp"

namespace mudline {

/// The mesh of the model that Gmsh has open, with elements of the given order and dimension (2 or 3). Elements are put
/// along a space-filling curve and nodes in the order the elements meet them, so that neighbours are close in memory;
/// nodes of no element are dropped; clockwise elements, and those of space with a negative volume, are turned over.
/// Throws InputError without a position.
GlobalMesh read_gmsh_model(int order, int dimension);

}  // namespace mudline
