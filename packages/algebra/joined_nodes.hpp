#pragma once

#include <memory>
#include <vector>

#include "algebra/mumps_factor.hpp"
#include "algebra/node_matrix.hpp"

namespace mudline {

/// The inverse of the block of a matrix that couples some nodes of this rank with each other.
class JoinedNodes {
 public:
  /// `joined`: by owned node; may be empty.
  JoinedNodes(const NodeMatrix& matrix, const std::vector<char>& joined);

  /// The joined nodes; empty where nothing is joined, or where the block is singular.
  const std::vector<int>& nodes() const { return nodes_; }
  /// Applies the inverse to the values of x (on the matrix' rows) at these nodes; the result lists the nodes one after
  /// the other.
  const MultiVector& solve(const MultiVector& x) const;

 private:
  std::vector<int> nodes_;
  int components_;
  std::unique_ptr<MumpsFactor> factor_;
  mutable RCP<MultiVector> right_, solution_;
};

}  // namespace mudline
