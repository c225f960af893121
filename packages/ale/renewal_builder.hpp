#pragma once

#include "ale/mesh_renewal.hpp"
#include "discretisation/triangulation.hpp"

namespace mudline {

// The new mesh of MeshRenewal::make(), of whatever quality. They throw NoTriangulation.

/// Triangles between the paths, divided anew.
RenewedMesh renewed_in_plane(const MeshRenewal& plan, const Positions& x, const State& state, const WantedSizes* sizes);
/// Tetrahedra within the boundary's faces as they are.
RenewedMesh renewed_in_space(const MeshRenewal& plan, const Positions& x, FilledBy way);

}  // namespace mudline
