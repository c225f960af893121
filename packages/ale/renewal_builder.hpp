#pragma once

#include "ale/mesh_renewal.hpp"
#include "ale/renewed_surface.hpp"

namespace mudline {

// The new mesh of MeshRenewal::make(), of whatever quality. They throw NoTriangulation.

/// Triangles between the paths, divided anew.
RenewedMesh renewed_in_plane(const MeshRenewal& plan, const Positions& x, const State& state, const WantedSizes* sizes);
/// Tetrahedra within the boundary's new faces, by a factor larger than these.
RenewedMesh renewed_in_space(const MeshRenewal& plan, const RenewedSurface& surface, const State& state, double factor);

}  // namespace mudline
