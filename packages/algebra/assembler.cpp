#include "algebra/assembler.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "algebra/tpetra_compat.hpp"

namespace mudline {

namespace {

using FEGraph = Tpetra::FECrsGraph<>;
using RowCounts = Kokkos::DualView<const std::size_t*, FEGraph::device_type>;
using HostElements = Kokkos::View<const int**, Kokkos::LayoutRight, Kokkos::HostSpace>;

/// Which elements touch each overlap dof: (group, element) pairs in compressed rows.
struct Incidence {
  std::vector<std::size_t> begin;
  std::vector<std::pair<int, int>> elements;
};

Incidence incidence(const std::vector<HostElements>& groups, int num_dofs) {
  Incidence result;
  result.begin.assign(num_dofs + 1, 0);
  for (const HostElements& group : groups)
    for (std::size_t e = 0; e < group.extent(0); ++e)
      for (std::size_t a = 0; a < group.extent(1); ++a) ++result.begin[group(e, a) + 1];
  for (int d = 0; d < num_dofs; ++d) result.begin[d + 1] += result.begin[d];
  result.elements.resize(result.begin[num_dofs]);
  std::vector<std::size_t> next(result.begin.begin(), result.begin.end() - 1);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t e = 0; e < groups[g].extent(0); ++e)
      for (std::size_t a = 0; a < groups[g].extent(1); ++a)
        result.elements[next[groups[g](e, a)]++] = {static_cast<int>(g), static_cast<int>(e)};
  return result;
}

/// The columns of every overlap row, each once, the diagonal always among them (a constrained dof without elements
/// still needs its one).
std::vector<std::vector<int>> sparsity(const std::vector<HostElements>& groups, int num_dofs) {
  const Incidence touching = incidence(groups, num_dofs);
  std::vector<std::vector<int>> rows(num_dofs);
  std::vector<int> last_row(num_dofs, -1);
  for (int row = 0; row < num_dofs; ++row) {
    std::vector<int>& columns = rows[row];
    columns.push_back(row);
    last_row[row] = row;
    for (std::size_t k = touching.begin[row]; k < touching.begin[row + 1]; ++k) {
      const auto [g, e] = touching.elements[k];
      for (std::size_t b = 0; b < groups[g].extent(1); ++b) {
        const int column = groups[g](e, b);
        if (last_row[column] == row) continue;
        last_row[column] = row;
        columns.push_back(column);
      }
    }
  }
  return rows;
}

RowCounts row_counts(const std::vector<std::vector<int>>& rows) {
  Kokkos::DualView<std::size_t*, FEGraph::device_type> counts("row counts", rows.size());
  for (std::size_t row = 0; row < rows.size(); ++row) counts.h_view(row) = rows[row].size();
  counts.modify_host();
  counts.sync_device();
  return counts;
}

std::vector<HostElements> on_host(const std::vector<ElementDofs>& groups) {
  std::vector<HostElements> result;
  for (const ElementDofs& group : groups)
    result.push_back(Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), group));
  return result;
}

}  // namespace

Assembler::Assembler(RCP<const DofMap> dofs) : dofs_(std::move(dofs)) {}

int Assembler::add_group(ElementDofs dofs) {
  if (!matrix_.is_null()) throw std::logic_error("element group added after the sparsity was built");
  groups_.push_back(dofs);
  return static_cast<int>(groups_.size()) - 1;
}

void Assembler::finalise() {
  const Map& overlap = *dofs_->overlap();
  const std::vector<std::vector<int>> rows = sparsity(on_host(groups_), dofs_->num_overlap_dofs());
  const auto graph = rcp(new FEGraph(dofs_->owned(), dofs_->overlap(), row_counts(rows)));
  graph->beginAssembly();
  std::vector<GlobalOrdinal> columns;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    columns.clear();
    for (const int column : rows[row]) columns.push_back(overlap.getGlobalElement(column));
    graph->insertGlobalIndices(overlap.getGlobalElement(static_cast<int>(row)),
                               Teuchos::ArrayView<const GlobalOrdinal>(columns.data(), columns.size()));
  }
  graph->endAssembly();
  matrix_ = rcp(new FEMatrix(graph));
  compute_offsets();
}

// The offsets are those of the owned-plus-shared matrix, which is the active one only during assembly; its values stay
// at one address, so that they serve every later assembly.
void Assembler::compute_offsets() {
  matrix_->beginAssembly();
  {
    const auto local = matrix_->getLocalMatrixHost();
    const Map& column_map = *matrix_->getColMap();
    std::vector<int> column_of(dofs_->num_overlap_dofs());
    for (int d = 0; d < dofs_->num_overlap_dofs(); ++d)
      column_of[d] = column_map.getLocalElement(dofs_->overlap()->getGlobalElement(d));

    for (const HostElements& group : on_host(groups_)) {
      const std::size_t size = group.extent(1);
      Kokkos::View<std::uint32_t***, Kokkos::LayoutRight> offsets("matrix offsets", group.extent(0), size, size);
      const auto host = Kokkos::create_mirror_view(offsets);
      for (std::size_t e = 0; e < group.extent(0); ++e)
        for (std::size_t a = 0; a < size; ++a) {
          const auto row = group(e, a);
          const auto* first = local.graph.entries.data() + local.graph.row_map(row);
          const auto* last = local.graph.entries.data() + local.graph.row_map(row + 1);
          for (std::size_t b = 0; b < size; ++b) {
            const auto* found = std::lower_bound(first, last, column_of[group(e, b)]);
            host(e, a, b) = static_cast<std::uint32_t>(found - local.graph.entries.data());
          }
        }
      Kokkos::deep_copy(offsets, host);
      offsets_.push_back(offsets);
    }
  }
  matrix_->endAssembly();
}

void Assembler::begin(Kokkos::View<const char*> constrained) {
  if (matrix_.is_null()) throw std::logic_error("assembly begun before the sparsity was built");
  constrained_ = constrained;
  matrix_->beginAssembly();
  matrix_->setAllToScalar(0);
}

MatrixScatter Assembler::scatter(int group) const {
  return {matrix_->getLocalMatrixDevice().values, offsets_[group], groups_[group], constrained_};
}

void Assembler::end() {
  matrix_->endAssembly();
  const auto constrained = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), constrained_);
  const Map& rows = *matrix_->getRowMap();
  const Map& columns = *matrix_->getColMap();
  const auto local = matrix_->getLocalMatrixHost();
  for (int row = 0; row < dofs_->num_owned_dofs(); ++row) {
    if (!constrained(row)) continue;
    const int diagonal = columns.getLocalElement(rows.getGlobalElement(row));
    for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k)
      if (local.graph.entries(k) == diagonal && local.values(k) == 0) local.values(k) = 1;
  }
}

}  // namespace mudline
