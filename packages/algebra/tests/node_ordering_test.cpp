#include "algebra/node_ordering.hpp"

#include <gtest/gtest.h>
#include <Tpetra_Core.hpp>

#include <algorithm>
#include <cstdlib>

namespace mudline {
namespace {

TEST(NodeOrdering, FieldsShareTheirNodes) {
  const DofMap dofs(Tpetra::getDefaultComm(),
                    {{"displacement", 3, {5, 7}, 2}, {"pore pressure", 1, {7}, 1}, {"body", 2, {0}, 1, true}});
  const std::vector<GlobalOrdinal> nodes = nodes_of_rows(dofs);
  ASSERT_EQ(nodes.size(), 9u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(nodes[i], 5);
    EXPECT_EQ(nodes[3 + i], 7);
  }
  EXPECT_EQ(nodes[6], 7);
  EXPECT_GT(nodes[7], 7);
  EXPECT_NE(nodes[7], nodes[8]);
}

TEST(NodeOrdering, EachRowHasAPlaceBesideTheOthersOfItsNode) {
  // a square grid of nodes with two rows each, joined to their neighbours along the lines
  constexpr int side = 12, count = side * side;
  std::vector<int> rows, columns;
  std::vector<GlobalOrdinal> node_of_row;
  for (int row = 0; row < 2 * count; ++row) node_of_row.push_back(100 + row % count);
  const auto neighbours = [&](int a, int b) {
    return std::abs(a % side - b % side) + std::abs(a / side - b / side) <= 1;
  };
  for (int i = 0; i < 2 * count; ++i)
    for (int j = 0; j < 2 * count; ++j)
      if (neighbours(i % count, j % count)) {
        rows.push_back(i + 1);
        columns.push_back(j + 1);
      }
  const std::vector<int> place = nested_dissection(rows, columns, node_of_row);
  std::vector<int> sorted = place;
  std::sort(sorted.begin(), sorted.end());
  for (int k = 0; k < 2 * count; ++k) EXPECT_EQ(sorted[k], k + 1);
  for (int node = 0; node < count; ++node) EXPECT_EQ(std::abs(place[node] - place[node + count]), 1);
}

}  // namespace
}  // namespace mudline
