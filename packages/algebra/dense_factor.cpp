#include "algebra/dense_factor.hpp"

#include <Teuchos_LAPACK.hpp>

#include <utility>

namespace mudline {

DenseFactor::DenseFactor(std::vector<double> matrix, int rows) : factors_(std::move(matrix)), pivots_(rows) {
  int problem = 0;
  Teuchos::LAPACK<int, double>().GETRF(rows, rows, factors_.data(), rows, pivots_.data(), &problem);
  regular_ = problem == 0;
}

void DenseFactor::solve(std::vector<double>& right) const {
  const int rows = static_cast<int>(pivots_.size());
  int problem = 0;
  Teuchos::LAPACK<int, double>().GETRS('N', rows, 1, factors_.data(), rows, pivots_.data(), right.data(), rows,
                                       &problem);
}

}  // namespace mudline
