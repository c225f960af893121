#pragma once

#include "ale/mesh_renewal.hpp"

namespace mudline {

// The new mesh of MeshRenewal::make(), of whatever quality. They throw NoTriangulation.

/// Triangles between the paths, divided anew.
RenewedMesh renewed_in_plane(const MeshRenewal& plan, const Positions& x, const State& state, const WantedSizes* sizes);
/// Tetrahedra within the boundary's faces as they are, by a factor larger than these.
RenewedMesh renewed_in_space(const MeshRenewal& plan, const Positions& x, double factor);

}  // namespace mudline
