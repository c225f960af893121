#include "integrator/overlap.hpp"

#include <cmath>

#include "algebra/ordered_sum.hpp"

namespace mudline {

namespace {

template <class View>
struct Products {
  View a, b;
  KOKKOS_FUNCTION void operator()(int i, double (&sum)[1]) const { sum[0] += a(i) * b(i); }
};

}  // namespace

std::vector<std::pair<int, int>> overlap_ranges(const DofMap& dofs, int f) {
  const FieldLayout& field = dofs.field(f);
  const int nodes = static_cast<int>(field.node_ids.size()), owned = field.num_owned;
  std::vector<std::pair<int, int>> ranges{{dofs.owned_begin(f), dofs.owned_end(f)}};
  if (nodes > owned) {
    const int begin = dofs.dof(f, owned);
    ranges.push_back({begin, begin + (nodes - owned) * field.components});
  }
  return ranges;
}

void import_owned(const DofMap& dofs, const Vector& owned, const NodalView& overlap) {
  Vector target(dofs.overlap());
  target.doImport(owned, *dofs.import(), Tpetra::INSERT);
  Kokkos::deep_copy(overlap, entries(target, Tpetra::Access::ReadOnly));
}

Vector owned_part(const DofMap& dofs, const NodalView& overlap) {
  Vector owned(dofs.owned());
  const auto first = Kokkos::subview(overlap, std::make_pair(0, dofs.num_owned_dofs()));
  Kokkos::deep_copy(entries(owned, Tpetra::Access::OverwriteAll), first);
  return owned;
}

void export_overlap(const DofMap& dofs, const NodalView& overlap, Vector& owned) {
  Vector source(dofs.overlap());
  Kokkos::deep_copy(entries(source, Tpetra::Access::OverwriteAll), overlap);
  owned.putScalar(0.0);
  owned.doExport(source, *dofs.import(), Tpetra::ADD);
}

NodalView sum_overlap(const DofMap& dofs, const NodalView& overlap) {
  Vector owned(dofs.owned());
  export_overlap(dofs, overlap, owned);
  NodalView result("sum", overlap.extent(0));
  import_owned(dofs, owned, result);
  return result;
}

std::vector<double> owned_field_products(const DofMap& dofs, const Vector& a, const Vector& b) {
  std::vector<double> sums(dofs.num_fields(), 0.0);
  {
    const auto one = entries(a, Tpetra::Access::ReadOnly), other = entries(b, Tpetra::Access::ReadOnly);
    for (int f = 0; f < dofs.num_fields(); ++f)
      sums[f] = ordered_sum<1>("products", dofs.owned_begin(f), dofs.owned_end(f),
                               Products<std::remove_const_t<decltype(one)>>{one, other})[0];
  }
  return sum_over_ranks(*dofs.comm(), sums);
}

std::vector<double> owned_field_norms(const DofMap& dofs, const Vector& v) {
  std::vector<double> norms = owned_field_products(dofs, v, v);
  for (double& s : norms) s = std::sqrt(s);
  return norms;
}

}  // namespace mudline
