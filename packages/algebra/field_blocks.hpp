#pragma once

#include <map>
#include <utility>
#include <vector>

#include "algebra/dof_map.hpp"

namespace mudline {

/// Cuts the monolithic matrix into one matrix per pair of fields. Each block lives on a map of its own whose global ids
/// are dense from 0, the components of a node adjacent and aligned (as multigrid expects), in the owned range's order.
/// The sparsity is sorted out once per graph, later matrices only copy values.
class FieldBlocks {
 public:
  FieldBlocks(const CrsMatrix& matrix, RCP<const DofMap> dofs);
  /// Whether `matrix` has the graph given at construction.
  bool fits(const CrsMatrix& matrix) const { return graph_ == matrix.getCrsGraph(); }

  const RCP<const Map>& map(int f) const { return maps_[f]; }
  /// Rows of field f, columns of field g, with the values of `matrix`. The same object each time, refilled.
  RCP<CrsMatrix> block(const CrsMatrix& matrix, int f, int g);
  /// A copy of a matrix given on dofs.field_map(f), on map(f).
  RCP<CrsMatrix> renumbered(const CrsMatrix& matrix, int f) const;
  /// Marks the owned dofs of field f whose rows of `matrix` hold nothing off the diagonal: the constrained ones.
  std::vector<char> isolated(const CrsMatrix& matrix, int f) const;

  /// The owned range of field f of a vector on the dof map, without copying.
  RCP<const MultiVector> part(const MultiVector& v, int f) const;
  RCP<MultiVector> part(MultiVector& v, int f) const;

 private:
  struct Block {
    RCP<CrsMatrix> matrix;
    std::vector<std::size_t> source;  // where each value stands in the monolithic matrix
  };
  Block cut(const CrsMatrix& matrix, int f, int g) const;

  RCP<const CrsMatrix::crs_graph_type> graph_;
  RCP<const DofMap> dofs_;
  std::vector<RCP<const Map>> maps_;
  std::vector<int> column_field_;         // by local column of the monolithic matrix
  std::vector<GlobalOrdinal> column_id_;  // ... and its dense id within the field
  std::map<std::pair<int, int>, Block> blocks_;
};

/// A matrix from compressed rows with local column indices.
RCP<CrsMatrix> make_matrix(const RCP<const Map>& rows, const RCP<const Map>& columns, const RCP<const Map>& domain,
                           const std::vector<std::size_t>& row_begin, const std::vector<LocalOrdinal>& entries,
                           const std::vector<double>& values);

/// Drops the off-diagonal entries of the marked rows (owned dofs) and of the columns that belong to them.
void isolate(CrsMatrix& matrix, const std::vector<char>& marked);

}  // namespace mudline
