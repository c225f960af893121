#include "algebra/assembler.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "algebra/tpetra_compat.hpp"

namespace mudline {

namespace {

using FEGraph = Tpetra::FECrsGraph<>;
using RowCounts = Kokkos::DualView<const std::size_t*, FEGraph::device_type>;
using HostElements = Kokkos::View<const int**, Kokkos::LayoutRight, Kokkos::HostSpace>;

/// Groups the overlap dofs into bundles, each with the components of one node. The rows of a bundle have the same
/// columns, and these are whole bundles.
struct Bundles {
  std::vector<int> begin;  // by bundle: its first dof; and the end
  std::vector<int> of;     // by dof: its bundle
  int count() const { return static_cast<int>(begin.size()) - 1; }
};

Bundles find_bundles(const DofMap& dofs) {
  Bundles bundles;
  const int count = dofs.num_overlap_dofs();
  bundles.of.assign(count, 0);
  std::vector<char> starts(count, 0);
  for (int f = 0; f < dofs.num_fields(); ++f)
    for (int i = 0; i < static_cast<int>(dofs.field(f).node_ids.size()); ++i) starts[dofs.dof(f, i)] = 1;
  for (int d = 0; d < count; ++d) {
    if (starts[d]) bundles.begin.push_back(d);
    bundles.of[d] = static_cast<int>(bundles.begin.size()) - 1;
  }
  bundles.begin.push_back(count);
  return bundles;
}

/// Calls action(bundle) for the bundles of an element; consecutive dofs of a bundle give one call.
template <class Action>
void for_each_bundle(const HostElements& group, std::size_t e, const Bundles& bundles, Action&& action) {
  int last = -1;
  for (std::size_t a = 0; a < group.extent(1); ++a) {
    const int bundle = bundles.of[group(e, a)];
    if (bundle != last) action(bundle);
    last = bundle;
  }
}

/// The elements that touch each bundle: (group, element) pairs in compressed rows.
struct Incidence {
  std::vector<std::size_t> begin;
  std::vector<std::pair<int, int>> elements;
};

Incidence incidence(const std::vector<HostElements>& groups, const Bundles& bundles) {
  Incidence result;
  result.begin.assign(bundles.count() + 1, 0);
  for (const HostElements& group : groups)
    for (std::size_t e = 0; e < group.extent(0); ++e)
      for_each_bundle(group, e, bundles, [&](int bundle) { ++result.begin[bundle + 1]; });
  for (int i = 0; i < bundles.count(); ++i) result.begin[i + 1] += result.begin[i];
  result.elements.resize(result.begin.back());
  std::vector<std::size_t> next(result.begin.begin(), result.begin.end() - 1);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t e = 0; e < groups[g].extent(0); ++e)
      for_each_bundle(groups[g], e, bundles, [&](int bundle) {
        result.elements[next[bundle]++] = {static_cast<int>(g), static_cast<int>(e)};
      });
  return result;
}

/// The neighbours of every bundle, each once and always including itself (a constrained dof without elements still
/// needs its diagonal).
std::vector<std::vector<int>> sparsity(const std::vector<HostElements>& groups, const Bundles& bundles) {
  const Incidence touching = incidence(groups, bundles);
  std::vector<std::vector<int>> rows(bundles.count());
  std::vector<int> last_row(bundles.count(), -1);
  for (int row = 0; row < bundles.count(); ++row) {
    std::vector<int>& columns = rows[row];
    columns.push_back(row);
    last_row[row] = row;
    for (std::size_t k = touching.begin[row]; k < touching.begin[row + 1]; ++k) {
      const auto [g, e] = touching.elements[k];
      for_each_bundle(groups[g], e, bundles, [&](int column) {
        if (last_row[column] == row) return;
        last_row[column] = row;
        columns.push_back(column);
      });
    }
  }
  return rows;
}

RowCounts row_counts(const std::vector<std::vector<int>>& rows, const Bundles& bundles) {
  Kokkos::DualView<std::size_t*, FEGraph::device_type> counts("row counts", bundles.of.size());
  for (std::size_t d = 0; d < bundles.of.size(); ++d) {
    counts.h_view(d) = 0;
    for (const int column : rows[bundles.of[d]]) counts.h_view(d) += bundles.begin[column + 1] - bundles.begin[column];
  }
  counts.modify_host();
  counts.sync_device();
  return counts;
}

/// Consecutive columns of a group that belong to one bundle in all of its elements form one node of the group.
std::vector<MatrixScatter::Place> find_places(const HostElements& group, const Bundles& bundles) {
  std::vector<MatrixScatter::Place> places;
  for (int a = 0; a < static_cast<int>(group.extent(1)); ++a) {
    bool goes_on = a > 0;
    for (std::size_t e = 0; e < group.extent(0); ++e) {
      if (!goes_on) break;
      goes_on = group(e, a) == group(e, a - 1) + 1 && bundles.of[group(e, a)] == bundles.of[group(e, a - 1)];
    }
    if (goes_on)
      places.push_back({places.back().node, places.back().component + 1});
    else
      places.push_back({places.empty() ? 0 : places.back().node + 1, 0});
  }
  return places;
}

std::vector<HostElements> on_host(const std::vector<ElementDofs>& groups) {
  std::vector<HostElements> result;
  for (const ElementDofs& group : groups)
    result.push_back(Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), group));
  return result;
}

/// Positions of the columns of a group's nodes in the rows of its nodes.
template <class T, class Graph>
Kokkos::View<T***, Kokkos::LayoutRight> find_positions(const HostElements& group,
                                                       const std::vector<MatrixScatter::Place>& places,
                                                       const std::vector<int>& column_of, const Graph& graph) {
  const std::size_t nodes = places.empty() ? 0 : places.back().node + 1;
  Kokkos::View<T***, Kokkos::LayoutRight> positions("matrix positions", group.extent(0), nodes, nodes);
  for (std::size_t e = 0; e < group.extent(0); ++e)
    for (std::size_t a = 0; a < places.size(); ++a) {
      const auto* first = graph.entries.data() + graph.row_map(group(e, a));
      const auto* last = graph.entries.data() + graph.row_map(group(e, a) + 1);
      for (std::size_t b = 0; b < places.size(); ++b) {
        const int column = column_of[group(e, b)];
        T& position = positions(e, places[a].node, places[b].node);
        if (places[a].component == 0 && places[b].component == 0)
          position = static_cast<T>(std::lower_bound(first, last, column) - first);
        const auto* const found = first + position + places[b].component;
        if (found >= last || *found != column)
          throw std::logic_error("the components of a node are not side by side in the matrix");
      }
    }
  return positions;
}

}  // namespace

void MatrixScatter::open_buffer(int elements) {
  const std::size_t columns = dofs.extent(1);
  const auto quickly = [](const std::string& label) { return Kokkos::view_alloc(label, Kokkos::WithoutInitializing); };
  buffer.values = decltype(buffer.values)(quickly("element matrices"), elements, columns, columns);
  spans = decltype(spans)(quickly("spans"), elements, columns);
}

Assembler::Assembler(RCP<const DofMap> dofs) : dofs_(std::move(dofs)) {}

int Assembler::add_group(ElementDofs dofs) {
  if (!matrix_.is_null()) throw std::logic_error("element group added after the sparsity was built");
  groups_.push_back(dofs);
  return static_cast<int>(groups_.size()) - 1;
}

void Assembler::finalise() {
  const Map& overlap = *dofs_->overlap();
  const Bundles bundles = find_bundles(*dofs_);
  const std::vector<std::vector<int>> rows = sparsity(on_host(groups_), bundles);
  const auto graph = rcp(new FEGraph(dofs_->owned(), dofs_->overlap(), row_counts(rows, bundles)));
  graph->beginAssembly();
  std::vector<GlobalOrdinal> columns;
  for (int row = 0; row < dofs_->num_overlap_dofs(); ++row) {
    columns.clear();
    for (const int column : rows[bundles.of[row]])
      for (int d = bundles.begin[column]; d < bundles.begin[column + 1]; ++d)
        columns.push_back(overlap.getGlobalElement(d));
    graph->insertGlobalIndices(overlap.getGlobalElement(row),
                               Teuchos::ArrayView<const GlobalOrdinal>(columns.data(), columns.size()));
  }
  graph->endAssembly();
  matrix_ = rcp(new FEMatrix(graph));
  find_entries();
}

// The positions are those in the owned-plus-shared matrix, which is the active one only during assembly; its values
// stay at one address, so that they serve every later assembly.
void Assembler::find_entries() {
  const Bundles bundles = find_bundles(*dofs_);
  matrix_->beginAssembly();
  {
    const auto local = matrix_->getLocalMatrixHost();
    const Map& column_map = *matrix_->getColMap();
    std::vector<int> column_of(dofs_->num_overlap_dofs());
    for (int d = 0; d < dofs_->num_overlap_dofs(); ++d)
      column_of[d] = column_map.getLocalElement(dofs_->overlap()->getGlobalElement(d));
    Kokkos::View<std::size_t*> row_begin("row begin", dofs_->num_overlap_dofs() + 1);
    Kokkos::deep_copy(row_begin, local.graph.row_map);
    row_begin_ = row_begin;

    std::size_t longest = 0;
    for (int d = 0; d < dofs_->num_overlap_dofs(); ++d)
      longest = std::max<std::size_t>(longest, row_begin(d + 1) - row_begin(d));
    for (const HostElements& group : on_host(groups_)) {
      const std::vector<MatrixScatter::Place> places = find_places(group, bundles);
      Kokkos::View<MatrixScatter::Place*> of_column("places", places.size());
      std::copy(places.begin(), places.end(), of_column.data());
      Entries entries;
      entries.places = of_column;
      if (longest <= std::numeric_limits<std::uint16_t>::max() + std::size_t(1))
        entries.positions.narrow = find_positions<std::uint16_t>(group, places, column_of, local.graph);
      else
        entries.positions.wide = find_positions<std::uint32_t>(group, places, column_of, local.graph);
      entries_.push_back(entries);
    }
  }
  matrix_->endAssembly();
}

void Assembler::begin(Kokkos::View<const char*> constrained) {
  if (matrix_.is_null()) throw std::logic_error("assembly begun before the sparsity was built");
  constrained_ = constrained;
  left_out_ = {};
  matrix_->beginAssembly();
  matrix_->setAllToScalar(0);
}

MatrixScatter Assembler::scatter(int group) const {
  return {matrix_->getLocalMatrixDevice().values,
          row_begin_,
          entries_[group].positions,
          entries_[group].places,
          groups_[group],
          constrained_,
          left_out_};
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
