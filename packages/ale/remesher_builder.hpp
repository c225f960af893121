#pragma once

#include "ale/remeshed_boundary.hpp"
#include "ale/remesher.hpp"

namespace mudline {

// The new mesh of Remesher::make(), before its quality is checked. Both functions throw NoTriangulation.

/// Triangles between the newly divided paths.
RemeshedMesh remeshed_in_plane(const Remesher& plan, const Positions& x, const State& state, const WantedSizes* sizes);
/// Tetrahedra within the boundary's new faces; `factor`: their size over that of these faces.
RemeshedMesh remeshed_in_space(const Remesher& plan, const RemeshedBoundary& surface, const State& state,
                               double factor);

}  // namespace mudline
