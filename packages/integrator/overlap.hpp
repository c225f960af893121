#pragma once

#include <utility>
#include <vector>

#include "algebra/over_ranks.hpp"
#include "framework/state.hpp"

namespace mudline {

/// The entries of a vector as a view of rank one, for kernels. access: Tpetra::Access::ReadOnly and its like.
template <class V, class Access>
auto entries(V& vector, Access access) {
  return Kokkos::subview(vector.getLocalViewDevice(access), Kokkos::ALL(), 0);
}
/// Local (overlap) dof ranges of one field: owned, then ghost.
std::vector<std::pair<int, int>> overlap_ranges(const DofMap& dofs, int field);
/// Owned vector -> overlap view (ghost copies filled). Collective.
void import_owned(const DofMap& dofs, const Vector& owned, const NodalView& overlap);
/// The owned entries of an overlap view.
Vector owned_part(const DofMap& dofs, const NodalView& overlap);
/// Sum of all ranks' contributions of an overlap view -> owned vector. Collective.
void export_overlap(const DofMap& dofs, const NodalView& overlap, Vector& owned);
/// Sum of all ranks' contributions, ghost copies filled. Collective.
NodalView sum_overlap(const DofMap& dofs, const NodalView& overlap);
/// Scalar products of the owned entries of each field over all ranks. Collective.
std::vector<double> owned_field_products(const DofMap& dofs, const Vector& a, const Vector& b);
/// Two-norms of the owned entries of each field over all ranks. Collective.
std::vector<double> owned_field_norms(const DofMap& dofs, const Vector& v);

}  // namespace mudline
