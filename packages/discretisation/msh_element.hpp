#pragma once

#include <optional>
#include <vector>

#include "discretisation/shapes.hpp"

namespace mudline {

/// An element type of Gmsh, with the number that it has in files.
struct MshElement {
  int type;
  const char* name;
  int dimension, nodes, corners;  // the corners are the first of its nodes
};

/// nullptr where Gmsh has no elements of that number, or none that this program knows.
const MshElement* msh_element(int type);

/// The cell that elements of a type become in a mesh of their dimension; none where no mesh takes them. 8-node
/// quadrilaterals become 9-node ones, and 20-node hexahedra become 27-node ones. (15-node prisms become 18-node ones in
/// meshes that have either.)
std::optional<CellShape> cell_of(int type);

/// For each node of a cell of that shape, its index among the element's nodes in Gmsh's order; -1 for the centres of
/// faces and cells that elements of 8, 15 and 20 nodes lack.
std::vector<int> order_of_nodes(int type, CellShape shape);

}  // namespace mudline
