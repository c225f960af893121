#pragma once

#include <vector>

#include "algebra/dof_map.hpp"
#include "algebra/node_matrix.hpp"

namespace mudline {

/// Cuts the monolithic matrix into one matrix per pair of fields. Each block lives on a map of its own whose global ids
/// are dense from 0, the components of a node adjacent and aligned (as multigrid expects), in the owned range's order.
/// Every call cuts its block afresh: calls are rare, and a faster way would take half a block's memory.
class FieldBlocks {
 public:
  FieldBlocks(const CrsMatrix& matrix, RCP<const DofMap> dofs);
  /// Whether `matrix` has the graph given at construction.
  bool fits(const CrsMatrix& matrix) const { return graph_ == matrix.getCrsGraph(); }

  const RCP<const Map>& map(int f) const { return maps_[f]; }
  /// Rows of field f, columns of field g, with the values of `matrix`.
  RCP<CrsMatrix> block(const CrsMatrix& matrix, int f, int g) const;
  /// Block (f, g) of `matrix` stored by nodes, in single precision.
  RCP<NodeMatrix> node_block(const CrsMatrix& matrix, int f, int g) const;
  /// A copy of a matrix given on dofs.field_map(f), on map(f).
  RCP<CrsMatrix> renumbered(const CrsMatrix& matrix, int f) const;
  /// Marks the owned dofs of field f whose rows of `matrix` hold nothing off the diagonal: the constrained ones.
  std::vector<char> isolated(const CrsMatrix& matrix, int f) const;

  /// The owned range of field f of a vector on the dof map, without copying.
  RCP<const MultiVector> part(const MultiVector& v, int f) const;
  RCP<MultiVector> part(MultiVector& v, int f) const;

 private:
  /// The columns of field g: for each column of the whole matrix its place in the block (-1: of another field), and the
  /// ids of the block's columns.
  struct Columns {
    std::vector<LocalOrdinal> place;
    std::vector<GlobalOrdinal> ids;
  };
  Columns columns_of(int g) const;

  RCP<const CrsMatrix::crs_graph_type> graph_;
  RCP<const DofMap> dofs_;
  std::vector<RCP<const Map>> maps_;
  std::vector<int> column_field_;         // by local column of the monolithic matrix
  std::vector<GlobalOrdinal> column_id_;  // by local column: its dense id within the field
};

/// Marks the owned rows from `begin` to `end` that hold nothing off the diagonal.
std::vector<char> isolated_rows(const CrsMatrix& matrix, LocalOrdinal begin, LocalOrdinal end);

/// Drops the off-diagonal entries of the marked rows (owned dofs) and of the columns that belong to them.
void isolate(CrsMatrix& matrix, const std::vector<char>& marked);

}  // namespace mudline
