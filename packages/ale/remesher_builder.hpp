#pragma once

#include "ale/remeshed_boundary.hpp"
#include "ale/remesher.hpp"

namespace mudline {

// The new mesh of Remesher::make(), of whatever quality. They throw NoTriangulation.

/// Triangles between the paths, divided anew.
RemeshedMesh remeshed_in_plane(const Remesher& plan, const Positions& x, const State& state, const WantedSizes* sizes);
/// Tetrahedra within the boundary's new faces, by a factor larger than these.
RemeshedMesh remeshed_in_space(const Remesher& plan, const RemeshedBoundary& surface, const State& state,
                               double factor);

}  // namespace mudline
