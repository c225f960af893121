#pragma once

#include <vector>

#include "ale/ghosted_mesh.hpp"
#include "discretisation/element_map.hpp"

namespace mudline {

/// Scaled Jacobian of an element [-], see ElementMap.
double scaled_jacobian(const GhostedMesh::Element& element, const Positions& x);

/// Smallest scaled Jacobian of the whole mesh; `worst`: position of a corner of the worst element [m]. Collective.
double lowest_quality(const GhostedMesh& mesh, const Positions& x, Point* worst = nullptr);

}  // namespace mudline
