#pragma once

#include <string>
#include <vector>

#include "algebra/dof_map.hpp"

namespace mudline {

/// The node number of each owned row, which all fields of a mesh node share; each row apart from the mesh has a number
/// of its own.
std::vector<GlobalOrdinal> nodes_of_rows(const DofMap& dofs);

/// An elimination order by nested dissection: the place of each row, from 1. It works on the graph of nodes, which is
/// several times smaller than that of rows, and keeps the rows of a node together. `rows`, `columns`: the matrix'
/// entries, from 1.
std::vector<int> nested_dissection(const std::vector<int>& rows, const std::vector<int>& columns,
                                   const std::vector<GlobalOrdinal>& node_of_row);

}  // namespace mudline
