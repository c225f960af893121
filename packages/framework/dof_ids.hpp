#pragma once

#include <vector>

#include "algebra/dof_map.hpp"

namespace mudline {

/// By local (overlap) dof: an id that does not depend on the number of ranks, other than the map's own global ids.
std::vector<long long> dof_ids(const DofMap& dofs);

}  // namespace mudline
