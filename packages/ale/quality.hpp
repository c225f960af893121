#pragma once

#include <vector>

#include "ale/whole_mesh.hpp"
#include "discretisation/element_map.hpp"

namespace mudline {

/// See ElementMap.
double scaled_jacobian(const WholeMesh::Element& element, const Positions& x);

/// Smallest scaled Jacobian of the mesh; `worst`: the element where it is.
double lowest_quality(const WholeMesh& mesh, const Positions& x, int* worst = nullptr);

}  // namespace mudline
