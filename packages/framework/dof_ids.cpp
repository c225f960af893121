#include "framework/dof_ids.hpp"

namespace mudline {

std::vector<long long> dof_ids(const DofMap& dofs) {
  constexpr long long most_components = 8;
  std::vector<long long> ids(dofs.num_overlap_dofs(), -1);
  for (int f = 0; f < dofs.num_fields(); ++f) {
    const FieldLayout& field = dofs.field(f);
    for (std::size_t i = 0; i < field.node_ids.size(); ++i)
      for (int c = 0; c < field.components; ++c)
        ids[dofs.dof(f, static_cast<int>(i)) + c] =
            (static_cast<long long>(field.node_ids[i]) * dofs.num_fields() + f) * most_components + c;
  }
  return ids;
}

}  // namespace mudline
