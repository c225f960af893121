#pragma once

#include <optional>
#include <vector>

#include "discretisation/shapes.hpp"

namespace mudline {

/// A kind of element by Gmsh's number for it, as it stands in its files.
struct MshElement {
  int type;
  const char* name;
  int dimension, nodes, corners;  // the corners are the first of its nodes
};

/// nullptr where Gmsh has no elements of that number, or none that this program knows.
const MshElement* msh_element(int type);

/// The cell that elements of a type become in a mesh of their dimension; none where no mesh takes them. Quadrilaterals
/// of 8 nodes become such of 9, and hexahedra of 20 nodes such of 27.
std::optional<CellShape> cell_of(int type);

/// The place among an element's nodes in Gmsh's order, by the node of the cell that it becomes; -1 for the centres of
/// faces and cells that elements of 8 and 20 nodes lack. The type must have a cell.
std::vector<int> order_of_nodes(int type);

}  // namespace mudline
