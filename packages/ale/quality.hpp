#pragma once

#include <vector>

#include "ale/whole_mesh.hpp"

namespace mudline {

/// Scaled Jacobian of an element: the smallest, over its nodes, of the Jacobian determinant divided by the product of
/// the lengths of the two edges that span it at the nearest corner, so that it is 1 for the equilateral triangle and for
/// the square, 0 for a degenerate and negative for a folded element (Knupp 2003). Curved sides count: the determinant is
/// that of the isoparametric map, at corners, middle nodes and the centre.
double scaled_jacobian(const WholeMesh::Element& element, const Positions& x);

/// Smallest scaled Jacobian of the mesh; `worst`: the element where it is.
double lowest_quality(const WholeMesh& mesh, const Positions& x, int* worst = nullptr);

}  // namespace mudline
