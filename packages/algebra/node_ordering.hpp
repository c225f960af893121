#pragma once

#include <string>
#include <vector>

#include "algebra/dof_map.hpp"

namespace mudline {

/// A number for each owned row that the rows of one mesh node have in common, over all fields; each row apart from the
/// mesh has its own.
std::vector<GlobalOrdinal> nodes_of_rows(const DofMap& dofs);

/// An order of elimination by nested dissection of the graph of nodes, which is several times smaller than that of rows
/// and keeps the rows of a node together: the place of each row, from 1. `rows`, `columns`: the matrix' entries,
/// from 1.
std::vector<int> nested_dissection(const std::vector<int>& rows, const std::vector<int>& columns,
                                   const std::vector<GlobalOrdinal>& node_of_row);

}  // namespace mudline
