#pragma once

#include <memory>
#include <vector>

#include "algebra/dense_factor.hpp"
#include "algebra/mumps_factor.hpp"
#include "algebra/node_matrix.hpp"

namespace mudline {

/// The inverse of the block of a matrix that couples some nodes of this rank with each other: dense factors by LAPACK
/// where the block is small, for MUMPS takes longer to begin than to factor it; sparse ones otherwise.
class JoinedNodes {
 public:
  /// `joined`: by owned node; may be empty.
  JoinedNodes(const NodeMatrix& matrix, const std::vector<char>& joined);

  /// The joined nodes; empty where nothing is joined, or where the block is singular.
  const std::vector<int>& nodes() const { return nodes_; }
  /// Applies the inverse to the values of x (on the matrix' rows) at these nodes; the result lists the nodes one after
  /// the other.
  const std::vector<double>& solve(const MultiVector& x) const;

 private:
  bool factor_dense(const NodeMatrix& matrix);
  bool factor_sparse(const NodeMatrix& matrix);

  std::vector<int> nodes_;
  int components_;
  DenseFactor dense_;
  std::unique_ptr<MumpsFactor> sparse_;    // null: the dense factors are there
  mutable RCP<MultiVector> right_, left_;  // of the sparse factors
  mutable std::vector<double> solution_;
};

}  // namespace mudline
