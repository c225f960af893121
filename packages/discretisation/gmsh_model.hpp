#pragma once

#include "discretisation/mesh.hpp"

namespace mudline {

/// The mesh of the model that Gmsh has open, with elements of the given order. Elements are put along a space-filling
/// curve and nodes in the order the elements meet them, so that neighbours are close in memory; nodes of no element
/// are dropped; clockwise elements are turned over. Throws InputError without a position.
GlobalMesh read_gmsh_model(int order);

}  // namespace mudline
