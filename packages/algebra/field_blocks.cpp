#include "algebra/field_blocks.hpp"

#include <algorithm>
#include <utility>

#include "algebra/tpetra_compat.hpp"

namespace mudline {

namespace {

using IdVector = Tpetra::Vector<GlobalOrdinal>;

/// A value per row, carried to the columns.
std::vector<GlobalOrdinal> on_columns(const std::vector<GlobalOrdinal>& by_row, const Map& rows,
                                      const RCP<const Map>& columns) {
  IdVector source(rcpFromRef(rows)), target(columns);
  {
    const auto values = source.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0; i < by_row.size(); ++i) values(i, 0) = by_row[i];
  }
  target.doImport(source, Import(rcpFromRef(rows), columns), Tpetra::INSERT);
  const auto values = target.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<GlobalOrdinal> result(local_size(*columns));
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = values(i, 0);
  return result;
}

/// A matrix whose rows begin as given among its entries; fill(entries, values) writes local columns and values.
template <class Fill>
RCP<CrsMatrix> make_matrix(const RCP<const Map>& rows, const RCP<const Map>& columns, const RCP<const Map>& domain,
                           const std::vector<std::size_t>& row_begin, Fill&& fill) {
  using Local = CrsMatrix::local_matrix_device_type;
  typename Local::row_map_type::non_const_type begin_view("row begin", row_begin.size());
  typename Local::index_type::non_const_type entry_view("entries", row_begin.back());
  typename Local::values_type::non_const_type value_view("values", row_begin.back());
  const auto begin_host = Kokkos::create_mirror_view(begin_view);
  const auto entry_host = Kokkos::create_mirror_view(entry_view);
  const auto value_host = Kokkos::create_mirror_view(value_view);
  std::copy(row_begin.begin(), row_begin.end(), begin_host.data());
  fill(entry_host.data(), value_host.data());
  Kokkos::deep_copy(begin_view, begin_host);
  Kokkos::deep_copy(entry_view, entry_host);
  Kokkos::deep_copy(value_view, value_host);
  const auto matrix = rcp(new CrsMatrix(rows, columns, begin_view, entry_view, value_view));
  matrix->expertStaticFillComplete(domain, rows);
  return matrix;
}

}  // namespace

FieldBlocks::FieldBlocks(const CrsMatrix& matrix, RCP<const DofMap> dofs)
    : graph_(matrix.getCrsGraph()), dofs_(std::move(dofs)) {
  std::vector<GlobalOrdinal> field(dofs_->num_owned_dofs()), id(dofs_->num_owned_dofs());
  for (int f = 0; f < dofs_->num_fields(); ++f) {
    const int begin = dofs_->owned_begin(f), end = dofs_->owned_end(f);
    maps_.push_back(make_dense_map(end - begin, dofs_->comm()));
    for (int dof = begin; dof < end; ++dof) {
      field[dof] = f;
      id[dof] = maps_[f]->getGlobalElement(dof - begin);
    }
  }
  const std::vector<GlobalOrdinal> column_field = on_columns(field, *dofs_->owned(), matrix.getColMap());
  column_field_.assign(column_field.begin(), column_field.end());
  column_id_ = on_columns(id, *dofs_->owned(), matrix.getColMap());
}

FieldBlocks::Columns FieldBlocks::columns_of(int g) const {
  Columns columns;
  columns.place.assign(column_field_.size(), -1);
  for (std::size_t column = 0; column < column_field_.size(); ++column)
    if (column_field_[column] == g) {
      columns.place[column] = static_cast<LocalOrdinal>(columns.ids.size());
      columns.ids.push_back(column_id_[column]);
    }
  return columns;
}

RCP<NodeMatrix> FieldBlocks::node_block(const CrsMatrix& matrix, int f, int g) const {
  const Columns columns = columns_of(g);
  return rcp(new NodeMatrix(matrix, dofs_->owned_begin(f), columns.place, {dofs_->field(f).components, maps_[f]},
                            {dofs_->field(g).components, maps_[g]}, make_map(columns.ids, dofs_->comm())));
}

RCP<CrsMatrix> FieldBlocks::block(const CrsMatrix& matrix, int f, int g) const {
  const Columns columns = columns_of(g);
  const auto local = matrix.getLocalMatrixHost();
  const auto for_each_entry = [&](int row, auto&& action) {
    for (std::size_t k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k)
      if (const LocalOrdinal column = columns.place[local.graph.entries(k)]; column >= 0)
        action(column, local.values(k));
  };
  const int first = dofs_->owned_begin(f), end = dofs_->owned_end(f);
  std::vector<std::size_t> row_begin{0};
  for (int row = first; row < end; ++row) {
    row_begin.push_back(row_begin.back());
    for_each_entry(row, [&](LocalOrdinal, double) { ++row_begin.back(); });
  }
  return make_matrix(maps_[f], make_map(columns.ids, dofs_->comm()), maps_[g], row_begin,
                     [&](LocalOrdinal* entries, double* values) {
                       for (int row = first; row < end; ++row)
                         for_each_entry(row, [&](LocalOrdinal column, double value) {
                           *entries++ = column;
                           *values++ = value;
                         });
                     });
}

RCP<CrsMatrix> FieldBlocks::renumbered(const CrsMatrix& matrix, int f) const {
  std::vector<GlobalOrdinal> id;
  for (int dof = dofs_->owned_begin(f); dof < dofs_->owned_end(f); ++dof)
    id.push_back(maps_[f]->getGlobalElement(dof - dofs_->owned_begin(f)));
  const RCP<const Map> columns = make_map(on_columns(id, *dofs_->field_map(f), matrix.getColMap()), dofs_->comm());
  const auto local = matrix.getLocalMatrixHost();
  std::vector<std::size_t> row_begin(local_rows(matrix) + 1, 0);
  for (std::size_t row = 0; row + 1 < row_begin.size(); ++row) row_begin[row + 1] = local.graph.row_map(row + 1);
  return make_matrix(maps_[f], columns, maps_[f], row_begin, [&](LocalOrdinal* entries, double* values) {
    std::copy_n(local.graph.entries.data(), row_begin.back(), entries);
    std::copy_n(local.values.data(), row_begin.back(), values);
  });
}

std::vector<char> FieldBlocks::isolated(const CrsMatrix& matrix, int f) const {
  return isolated_rows(matrix, dofs_->owned_begin(f), dofs_->owned_end(f));
}

RCP<const MultiVector> FieldBlocks::part(const MultiVector& v, int f) const {
  return v.offsetView(maps_[f], dofs_->owned_begin(f));
}

RCP<MultiVector> FieldBlocks::part(MultiVector& v, int f) const {
  return v.offsetViewNonConst(maps_[f], dofs_->owned_begin(f));
}

std::vector<char> isolated_rows(const CrsMatrix& matrix, LocalOrdinal begin, LocalOrdinal end) {
  const auto local = matrix.getLocalMatrixHost();
  std::vector<char> result;
  for (LocalOrdinal row = begin; row < end; ++row) {
    const LocalOrdinal diagonal = matrix.getColMap()->getLocalElement(matrix.getRowMap()->getGlobalElement(row));
    char alone = 1;
    for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
      if (local.graph.entries(k) == diagonal || local.values(k) == 0) continue;
      alone = 0;
      break;
    }
    result.push_back(alone);
  }
  return result;
}

void isolate(CrsMatrix& matrix, const std::vector<char>& marked) {
  const std::vector<GlobalOrdinal> by_row(marked.begin(), marked.end());
  const std::vector<GlobalOrdinal> by_column = on_columns(by_row, *matrix.getRowMap(), matrix.getColMap());
  const auto local = matrix.getLocalMatrixHost();
  for (std::size_t row = 0; row < marked.size(); ++row) {
    const LocalOrdinal diagonal =
        matrix.getColMap()->getLocalElement(matrix.getRowMap()->getGlobalElement(static_cast<LocalOrdinal>(row)));
    for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
      const LocalOrdinal column = local.graph.entries(k);
      if (column != diagonal && (marked[row] || by_column[column])) local.values(k) = 0;
    }
  }
}

}  // namespace mudline
