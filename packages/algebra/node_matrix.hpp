#pragma once

#include <vector>

#include "algebra/types.hpp"

namespace mudline {

/// A matrix stored as the blocks that couple the unknowns of two nodes, in single precision, for preconditioners. A
/// displacement block takes a third of the memory of a CrsMatrix.
class NodeMatrix : public Operator {
 public:
  /// Unknowns of a field: their number on a node, where they are adjacent, and their map.
  struct Unknowns {
    int components;
    RCP<const Map> map;
  };
  /// Takes the rows of `matrix` from `first_row` on. `place_of_column` gives the place of each of its columns in
  /// `columns` (-1: left out), the map of the unknowns of `domain` that the rows use. All rows of a node have the same
  /// columns.
  NodeMatrix(const CrsMatrix& matrix, LocalOrdinal first_row, const std::vector<LocalOrdinal>& place_of_column,
             const Unknowns& rows, const Unknowns& domain, RCP<const Map> columns);
  /// Takes all of a square matrix.
  NodeMatrix(const CrsMatrix& matrix, int components);

  RCP<const Map> getDomainMap() const override { return domain_; }
  RCP<const Map> getRangeMap() const override { return rows_; }
  /// y = beta y + alpha A x
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp mode = Teuchos::NO_TRANS, double alpha = 1,
             double beta = 0) const override;

  /// Unknowns of a row node; in a square matrix also of a column node.
  int components() const { return components_; }
  int nodes() const { return static_cast<int>(begin_.size()) - 1; }
  const RCP<const Map>& columns() const { return columns_; }
  /// Import from the domain map to the column map; null where these are the same.
  const RCP<const Import>& import() const { return import_; }
  /// Calls action(column node, block) for the blocks of a row of nodes; a block is row by row.
  template <class Action>
  void for_each_block(int node, Action&& action) const {
    const int size = components_ * column_components_;
    for (std::size_t k = begin_[node]; k < begin_[node + 1]; ++k) action(column_[k], &values_[k * size]);
  }

 private:
  void read(const CrsMatrix& matrix, LocalOrdinal first_row, const std::vector<LocalOrdinal>& place_of_column);
  template <int N, int M>
  void product(const double* x, double* y, double alpha, double beta) const;

  RCP<const Map> rows_, domain_, columns_;
  RCP<const Import> import_;
  int components_, column_components_;
  std::vector<std::size_t> begin_;  // by node: its first block
  std::vector<int> column_;         // by block: its column node
  std::vector<float> values_;       // (block, row, column)
  mutable RCP<MultiVector> on_columns_;
};

/// The product P^T A P of a square matrix A with a prolongator P whose domain map is dense and aligned like the rows of
/// A.
RCP<CrsMatrix> galerkin_product(const CrsMatrix& prolongator, const NodeMatrix& matrix);

}  // namespace mudline
