#include "algebra/nodal_chebyshev.hpp"

#include <gtest/gtest.h>
#include <Tpetra_Core.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "algebra/tpetra_compat.hpp"
#include "core/pi.hpp"
#include "tensor/mat.hpp"

namespace mudline {
namespace {

constexpr int nodes = 60;

/// A chain of nodes, each joined to its neighbours by the same unsymmetric block: the eigenvalues of D^-1 A are
/// 1 - cos(k pi/(nodes + 1)), those of the chain, whatever the block.
RCP<CrsMatrix> chain(int n) {
  const Mat<double, 3> block = {{{5e6, 2e6, -1e6}, {-3e6, 4, 1}, {1e6, 0, 2e3}}};
  const auto matrix = rcp(new CrsMatrix(make_dense_map(nodes * n, Tpetra::getDefaultComm()), 3 * n));
  for (int a = 0; a < nodes; ++a)
    for (int b = std::max(0, a - 1); b < std::min(nodes, a + 2); ++b)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const double value = (a == b ? 2 : -1) * block[i][j];
          const GlobalOrdinal column = n * b + j;
          matrix->insertGlobalValues(n * a + i, 1, &value, &column);
        }
  matrix->fillComplete();
  return matrix;
}

/// Share of the k-th mode of the chain that is left of an error after one smoothing.
double left_of_mode(const NodalChebyshev& smoother, const CrsMatrix& matrix, int n, int k) {
  Vector error(matrix.getRowMap()), right(matrix.getRowMap()), correction(matrix.getRowMap());
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < n; ++i) error.replaceLocalValue(n * a + i, (i + 1) * std::sin(k * (a + 1) * pi / (nodes + 1)));
  const double before = error.norm2();
  matrix.apply(error, right);
  smoother.apply(right, correction);
  error.update(-1, correction, 1);
  return error.norm2() / before;
}

TEST(NodalChebyshev, SmoothsAsOnTheScalarChain) {
  for (const int n : {2, 3})
    for (const NodalChebyshev::Settings settings : {NodalChebyshev::Settings{2, 10}, NodalChebyshev::Settings{6, 30}}) {
      const RCP<CrsMatrix> matrix = chain(n);
      const NodalChebyshev smoother(rcp(new NodeMatrix(*matrix, n)), settings);
      EXPECT_GT(smoother.largest_eigenvalue(), 1.7);
      EXPECT_LE(smoother.largest_eigenvalue(), 2);
      const double largest = 1.1 * smoother.largest_eigenvalue(),
                   smallest = smoother.largest_eigenvalue() / settings.ratio;
      const double bound = 1 / std::cosh(settings.degree * std::acosh((largest + smallest) / (largest - smallest)));
      for (int k = 1; k <= nodes; k += 7) {
        const double eigenvalue = 1 - std::cos(k * pi / (nodes + 1));
        const double left = left_of_mode(smoother, *matrix, n, k);
        if (eigenvalue >= smallest)
          EXPECT_LE(left, bound * 1.0001) << "mode " << k;
        else
          EXPECT_LT(left, 1) << "mode " << k;
      }
    }
}

TEST(NodalChebyshev, RepeatsItself) {
  const auto matrix = rcp(new NodeMatrix(*chain(3), 3));
  EXPECT_EQ(NodalChebyshev(matrix, {}).largest_eigenvalue(), NodalChebyshev(matrix, {}).largest_eigenvalue());
}

TEST(NodalChebyshev, JoinedNodesAreSolvedTogether) {
  constexpr int n = 3;
  const RCP<CrsMatrix> matrix = chain(n);
  std::vector<char> joined(nodes, 1);
  const auto blocks = rcp(new NodeMatrix(*matrix, n));
  EXPECT_NEAR(NodalChebyshev(blocks, {}, joined).largest_eigenvalue(), 1, 1e-3);
  std::fill_n(joined.begin() + nodes / 2, nodes / 2, 0);
  const NodalChebyshev::Settings once{1, 10};
  const NodalChebyshev smoother(blocks, once, joined);
  Vector right(matrix->getRowMap()), solution(matrix->getRowMap()), product(matrix->getRowMap());
  for (int row = 0; row < n * nodes / 2; ++row) right.replaceLocalValue(row, 1 + row % 7);
  smoother.apply(right, solution);
  matrix->apply(solution, product);
  product.scale(0.5 * smoother.largest_eigenvalue() * (1.1 + 1 / once.ratio));  // the centre of what is smoothed
  const auto given = right.getLocalViewHost(Tpetra::Access::ReadOnly),
             found = product.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (int row = 0; row < n * nodes / 2; ++row) EXPECT_NEAR(found(row, 0), given(row, 0), 1e-2) << row;
}

TEST(NodalChebyshev, ASingularBlockIsTakenByItsDiagonal) {
  const auto matrix = rcp(new CrsMatrix(make_dense_map(2, Tpetra::getDefaultComm()), 2));
  for (GlobalOrdinal row = 0; row < 2; ++row)
    for (GlobalOrdinal column = 0; column < 2; ++column) {
      const double one = 1;
      matrix->insertGlobalValues(row, 1, &one, &column);
    }
  matrix->fillComplete();
  EXPECT_NEAR(NodalChebyshev(rcp(new NodeMatrix(*matrix, 2)), {}).largest_eigenvalue(), 2, 1e-12);
}

}  // namespace
}  // namespace mudline
