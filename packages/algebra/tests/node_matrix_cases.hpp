#pragma once

// Checks shared by the one-rank and the two-rank test programs.

#include <gtest/gtest.h>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>

#include <cmath>
#include <vector>

#include "algebra/node_matrix.hpp"
#include "algebra/tpetra_compat.hpp"

namespace mudline::cases {

constexpr int chain_nodes = 21;

/// A chain of nodes that are joined to their first and second neighbours by blocks of pseudo-random numbers.
inline RCP<CrsMatrix> rough_chain(int n) {
  const RCP<const Map> rows = make_map(
      [&] {  // the first nine nodes on the first rank of two
        const auto comm = Tpetra::getDefaultComm();
        const int begin = comm->getRank() == 0 ? 0 : 9 * n,
                  end = comm->getSize() == comm->getRank() + 1 ? chain_nodes * n : 9 * n;
        std::vector<GlobalOrdinal> ids;
        for (int id = begin; id < end; ++id) ids.push_back(id);
        return ids;
      }(),
      Tpetra::getDefaultComm());
  const auto matrix = rcp(new CrsMatrix(rows, 5 * n));
  for (const GlobalOrdinal row : local_ids(*rows))
    for (int b = std::max<int>(0, row / n - 2); b < std::min<int>(chain_nodes, row / n + 3); ++b)
      for (int j = 0; j < n; ++j) {
        const GlobalOrdinal column = n * b + j;
        const double value = std::sin(1.3 * row + 0.7 * column * column);
        matrix->insertGlobalValues(row, 1, &value, &column);
      }
  matrix->fillComplete();
  return matrix;
}

/// A prolongator from every other node to all nodes; the second component of node 4 is fixed.
inline RCP<CrsMatrix> chain_prolongator(const RCP<const Map>& rows, int n) {
  std::vector<GlobalOrdinal> coarse;
  for (const GlobalOrdinal row : local_ids(*rows))
    if (row / n % 2 == 0) coarse.push_back(row / n / 2 * n + row % n);
  const auto prolongator = rcp(new CrsMatrix(rows, 2));
  for (const GlobalOrdinal row : local_ids(*rows)) {
    const int node = row / n, component = row % n;
    const auto insert = [&](int vertex, double weight) {
      const GlobalOrdinal column = vertex * n + component;
      prolongator->insertGlobalValues(row, 1, &weight, &column);
    };
    if (node % 2 == 0) {
      insert(node / 2, 1);
      continue;
    }
    for (const int vertex : {node / 2, node / 2 + 1})
      if (vertex != 2 || component != 1) insert(vertex, 0.5);
  }
  prolongator->fillComplete(make_map(coarse, rows->getComm()), rows);
  return prolongator;
}

/// All entries of a matrix in dense form, on every rank.
inline std::vector<double> dense(const CrsMatrix& matrix) {
  const std::size_t width = matrix.getDomainMap()->getGlobalNumElements();
  std::vector<double> here(matrix.getGlobalNumRows() * width, 0.0), all(here.size());
  const auto local = matrix.getLocalMatrixHost();
  for (std::size_t row = 0; row < local_rows(matrix); ++row)
    for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k)
      here[matrix.getRowMap()->getGlobalElement(static_cast<LocalOrdinal>(row)) * width +
           matrix.getColMap()->getGlobalElement(local.graph.entries(k))] += local.values(k);
  Teuchos::reduceAll(*matrix.getComm(), Teuchos::REDUCE_SUM, static_cast<int>(here.size()), here.data(), all.data());
  return all;
}

inline void check_node_matrix() {
  for (const int n : {2, 3}) {
    const RCP<CrsMatrix> matrix = rough_chain(n);
    const NodeMatrix by_nodes(*matrix, n);
    Vector x(matrix->getRowMap()), y(matrix->getRowMap());
    for (const GlobalOrdinal id : local_ids(*matrix->getRowMap())) x.replaceGlobalValue(id, std::cos(0.3 * id));
    y.putScalar(3);
    Vector expected(y, Teuchos::Copy);
    matrix->apply(x, expected, Teuchos::NO_TRANS, -2, 0.5);
    by_nodes.apply(x, y, Teuchos::NO_TRANS, -2, 0.5);
    y.update(-1, expected, 1);
    EXPECT_LT(y.normInf(), 1e-6);  // single precision

    const RCP<CrsMatrix> prolongator = chain_prolongator(matrix->getRowMap(), n);
    const std::vector<double> p = dense(*prolongator), a = dense(*matrix),
                              coarse = dense(*galerkin_product(*prolongator, by_nodes));
    const int rows = chain_nodes * n, columns = (chain_nodes / 2 + 1) * n;
    ASSERT_EQ(coarse.size(), static_cast<std::size_t>(columns * columns));
    for (int i = 0; i < columns; ++i)
      for (int j = 0; j < columns; ++j) {
        double sum = 0;
        for (int k = 0; k < rows; ++k)
          for (int l = 0; l < rows; ++l) sum += p[k * columns + i] * a[k * rows + l] * p[l * columns + j];
        EXPECT_NEAR(coarse[i * columns + j], sum, 1e-6) << i << " " << j;
      }
  }
}

}  // namespace mudline::cases
