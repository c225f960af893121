#pragma once

#include <vector>

#include "algebra/dof_map.hpp"

namespace mudline {

/// Ids by local (overlap) dof. Unlike the map's global ids they do not depend on the number of ranks.
std::vector<long long> dof_ids(const DofMap& dofs);

}  // namespace mudline
