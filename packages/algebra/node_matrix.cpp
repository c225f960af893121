#include "algebra/node_matrix.hpp"

#include <Tpetra_Export.hpp>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "algebra/tpetra_compat.hpp"

namespace mudline {

namespace {

std::vector<LocalOrdinal> all_columns(const CrsMatrix& matrix) {
  std::vector<LocalOrdinal> places(local_size(*matrix.getColMap()));
  std::iota(places.begin(), places.end(), 0);
  return places;
}

}  // namespace

NodeMatrix::NodeMatrix(const CrsMatrix& matrix, LocalOrdinal first_row,
                       const std::vector<LocalOrdinal>& place_of_column, const Unknowns& rows, const Unknowns& domain,
                       RCP<const Map> columns)
    : rows_(rows.map),
      domain_(domain.map),
      columns_(std::move(columns)),
      components_(rows.components),
      column_components_(domain.components) {
  if (!domain_->isSameAs(*columns_)) {
    import_ = rcp(new Import(domain_, columns_));
    on_columns_ = rcp(new MultiVector(columns_, 1));
  }
  read(matrix, first_row, place_of_column);
}

NodeMatrix::NodeMatrix(const CrsMatrix& matrix, int components)
    : NodeMatrix(matrix, 0, all_columns(matrix), {components, matrix.getRowMap()}, {components, matrix.getRowMap()},
                 matrix.getColMap()) {}

void NodeMatrix::read(const CrsMatrix& matrix, LocalOrdinal first_row,
                      const std::vector<LocalOrdinal>& place_of_column) {
  const int n = components_, m = column_components_, nodes = static_cast<int>(local_size(*rows_)) / n;
  const auto local = matrix.getLocalMatrixHost();
  begin_.assign(nodes + 1, 0);
  for (int node = 0; node < nodes; ++node) {
    const LocalOrdinal row = first_row + n * node;
    std::size_t count = 0;
    for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k)
      if (place_of_column[local.graph.entries(k)] >= 0) ++count;
    begin_[node + 1] = begin_[node] + count / m;
  }
  column_.resize(begin_.back());
  values_.resize(begin_.back() * n * m);
  for (int node = 0; node < nodes; ++node)
    for (int i = 0; i < n; ++i) {
      const LocalOrdinal row = first_row + n * node + i;
      std::size_t entry = begin_[node] * m;  // counts the columns of this row
      for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k) {
        const LocalOrdinal place = place_of_column[local.graph.entries(k)];
        if (place < 0) continue;
        const std::size_t block = entry / m, j = entry % m;
        if (i == 0 && j == 0 && block < begin_[node + 1]) column_[block] = place / m;
        if (block >= begin_[node + 1] || place != m * column_[block] + static_cast<LocalOrdinal>(j))
          throw std::logic_error("the unknowns of a node do not share their columns");
        values_[(block * n + i) * m + j] = static_cast<float>(local.values(k));
        ++entry;
      }
    }
}

template <int N, int M>
void NodeMatrix::product(const double* x, double* y, double alpha, double beta) const {
  const float* block = values_.data();
  for (int node = 0; node < nodes(); ++node, y += N) {
    double sum[N] = {};
    for (std::size_t k = begin_[node]; k < begin_[node + 1]; ++k, block += N * M) {
      const double* const from = x + static_cast<std::size_t>(M) * column_[k];
      for (int i = 0; i < N; ++i)
        for (int j = 0; j < M; ++j) sum[i] += block[M * i + j] * from[j];
    }
    for (int i = 0; i < N; ++i) y[i] = (beta == 0 ? 0.0 : beta * y[i]) + alpha * sum[i];
  }
}

namespace {

/// Calls f(number as a constant) for 1, 2 or 3.
template <class F>
void with_components(int count, F&& f) {
  if (count == 1) return f(std::integral_constant<int, 1>());
  if (count == 2) return f(std::integral_constant<int, 2>());
  if (count == 3) return f(std::integral_constant<int, 3>());
  throw std::logic_error("a node matrix has one to three unknowns per node");
}

}  // namespace

void NodeMatrix::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp mode, double alpha, double beta) const {
  if (mode != Teuchos::NO_TRANS) throw std::logic_error("a node matrix has no transposed product");
  if (!import_.is_null()) on_columns_->doImport(x, *import_, Tpetra::INSERT);
  const MultiVector& whole = import_.is_null() ? x : *on_columns_;
  const auto from = whole.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto to = y.getLocalViewHost(Tpetra::Access::ReadWrite);
  with_components(components_, [&](auto n) {
    with_components(column_components_, [&](auto m) {
      product<decltype(n)::value, decltype(m)::value>(from.data(), to.data(), alpha, beta);
    });
  });
}

namespace {

/// The rows of a prolongator by nodes: the coarse nodes that each node interpolates from, and the weight of each
/// component.
struct NodalWeights {
  std::vector<GlobalOrdinal> coarse;  // ids of the coarse nodes, ascending
  std::vector<std::size_t> begin;     // by fine node: its first entry
  std::vector<int> parent;            // index among `coarse`
  std::vector<double> weight;         // (entry, component)
};

NodalWeights nodal_weights(const CrsMatrix& prolongator, int n) {
  NodalWeights result;
  const Map& columns = *prolongator.getColMap();
  for (const GlobalOrdinal id : local_ids(columns)) result.coarse.push_back(id / n);
  std::sort(result.coarse.begin(), result.coarse.end());
  result.coarse.erase(std::unique(result.coarse.begin(), result.coarse.end()), result.coarse.end());
  const auto local = prolongator.getLocalMatrixHost();
  result.begin.push_back(0);
  for (int node = 0; node < static_cast<int>(local_rows(prolongator)) / n; ++node) {
    const std::size_t first = result.begin.back();
    for (int i = 0; i < n; ++i)
      for (auto k = local.graph.row_map(n * node + i); k < local.graph.row_map(n * node + i + 1); ++k) {
        const GlobalOrdinal id = columns.getGlobalElement(local.graph.entries(k)) / n;
        const auto place = std::lower_bound(result.coarse.begin(), result.coarse.end(), id);
        const int parent = static_cast<int>(place - result.coarse.begin());
        std::size_t entry =
            std::find(result.parent.begin() + first, result.parent.end(), parent) - result.parent.begin();
        if (entry == result.parent.size()) {
          result.parent.push_back(parent);
          result.weight.resize(result.weight.size() + n, 0.0);
        }
        result.weight[entry * n + i] = local.values(k);
      }
    result.begin.push_back(result.parent.size());
  }
  return result;
}

/// The product P^T A P, one row of coarse nodes after the other, on the coarse nodes that this rank's rows interpolate
/// from.
class NodalProduct {
 public:
  NodalProduct(const NodeMatrix& matrix, const NodalWeights& weights) : matrix_(matrix), weights_(weights) {
    begin_.assign(weights.coarse.size() + 1, 0);
    for (std::size_t k = 0; k < weights.begin[matrix.nodes()]; ++k) ++begin_[weights.parent[k] + 1];
    for (std::size_t i = 0; i < weights.coarse.size(); ++i) begin_[i + 1] += begin_[i];
    child_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (int node = 0; node < matrix.nodes(); ++node)
      for (std::size_t k = weights.begin[node]; k < weights.begin[node + 1]; ++k)
        child_[next[weights.parent[k]]++] = {node, k};
  }

  RCP<CrsMatrix> matrix(const RCP<const Map>& dofs, const RCP<const Map>& domain) const {
    using Local = CrsMatrix::local_matrix_device_type;
    const int n = matrix_.components();
    std::vector<std::size_t> begin;
    std::vector<int> columns;
    find_columns(begin, columns);
    const std::size_t rows = weights_.coarse.size();
    Local::row_map_type::non_const_type row_map("row begin", n * rows + 1);
    Local::index_type::non_const_type entries("entries", columns.size() * n * n);
    Local::values_type::non_const_type values("values", columns.size() * n * n);
    std::vector<int> place(rows, -1);
    std::size_t first = 0;
    for (std::size_t row = 0; row < rows; ++row) {
      const std::size_t count = begin[row + 1] - begin[row], width = n * count;
      for (std::size_t k = 0; k < count; ++k) place[columns[begin[row] + k]] = static_cast<int>(k);
      for (int i = 0; i < n; ++i) {
        row_map(n * row + i) = first + i * width;
        for (std::size_t k = 0; k < width; ++k)
          entries(first + i * width + k) = n * columns[begin[row] + k / n] + static_cast<int>(k % n);
      }
      for_each_product(row, [&](int column, const double* left, const float* block, const double* right) {
        double* const to = &values(first + n * place[column]);
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j) to[i * width + j] += left[i] * block[n * i + j] * right[j];
      });
      first += n * width;
    }
    row_map(n * rows) = first;
    const auto product = rcp(new CrsMatrix(dofs, dofs, row_map, entries, values));
    product->expertStaticFillComplete(domain, domain);
    return product;
  }

 private:
  /// Calls action(coarse column, weights of the row, block, weights of the column).
  template <class Action>
  void for_each_product(std::size_t row, Action&& action) const {
    const int n = matrix_.components();
    for (std::size_t c = begin_[row]; c < begin_[row + 1]; ++c)
      matrix_.for_each_block(child_[c].first, [&](int column, const float* block) {
        for (std::size_t k = weights_.begin[column]; k < weights_.begin[column + 1]; ++k)
          action(weights_.parent[k], &weights_.weight[child_[c].second * n], block, &weights_.weight[k * n]);
      });
  }
  void find_columns(std::vector<std::size_t>& begin, std::vector<int>& columns) const {
    std::vector<int> last_row(weights_.coarse.size(), -1);
    begin.push_back(0);
    for (std::size_t row = 0; row < weights_.coarse.size(); ++row) {
      for_each_product(row, [&](int column, const double*, const float*, const double*) {
        if (last_row[column] == static_cast<int>(row)) return;
        last_row[column] = static_cast<int>(row);
        columns.push_back(column);
      });
      std::sort(columns.begin() + begin.back(), columns.end());
      begin.push_back(columns.size());
    }
  }

  const NodeMatrix& matrix_;
  const NodalWeights& weights_;
  std::vector<std::size_t> begin_;                  // by coarse node: its first child
  std::vector<std::pair<int, std::size_t>> child_;  // fine node and its entry among the weights
};

}  // namespace

RCP<CrsMatrix> galerkin_product(const CrsMatrix& prolongator, const NodeMatrix& matrix) {
  const int n = matrix.components();
  const RCP<const Map> domain = prolongator.getDomainMap();
  RCP<const CrsMatrix> on_columns = rcpFromRef(prolongator);
  if (!matrix.import().is_null())
    on_columns =
        Tpetra::importAndFillCompleteCrsMatrix<CrsMatrix>(on_columns, *matrix.import(), domain, matrix.columns());
  const NodalWeights weights = nodal_weights(*on_columns, n);
  std::vector<GlobalOrdinal> ids;
  for (const GlobalOrdinal node : weights.coarse)
    for (int i = 0; i < n; ++i) ids.push_back(n * node + i);
  const RCP<const Map> dofs = make_map(ids, domain->getComm());
  const NodalProduct product(matrix, weights);
  if (domain->getComm()->getSize() == 1) return product.matrix(domain, domain);
  const RCP<const CrsMatrix> part = product.matrix(dofs, domain);
  return Tpetra::exportAndFillCompleteCrsMatrix<CrsMatrix>(part, Tpetra::Export<>(dofs, domain), domain, domain);
}

}  // namespace mudline
