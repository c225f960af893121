#pragma once

#include <vector>

namespace mudline {

/// LU factors of a small dense matrix by LAPACK, the same on every rank that has the matrix.
class DenseFactor {
 public:
  DenseFactor() = default;
  /// `matrix`: square, column by column.
  DenseFactor(std::vector<double> matrix, int rows);

  bool regular() const { return regular_; }
  /// Replaces a right side by the solution; the matrix must be regular.
  void solve(std::vector<double>& right) const;

 private:
  std::vector<double> factors_;
  std::vector<int> pivots_;
  bool regular_ = false;
};

}  // namespace mudline
