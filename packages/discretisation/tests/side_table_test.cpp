#include "discretisation/side_table.hpp"

#include <gtest/gtest.h>

namespace mudline {
namespace {

TEST(SideTable, NumbersKeysInTheOrderInWhichTheyAreMet) {
  SideTable table(3);  // far fewer than the actual number of keys
  for (int round = 0; round < 2; ++round)
    for (long long i = 0; i < 1000; ++i) EXPECT_EQ(table.number({i % 7, i, i + 1, -1}), static_cast<std::size_t>(i));
  EXPECT_EQ(table.size(), 1000u);
  EXPECT_EQ(table.number({0, 0, 1, 5}), 1000u) << "a face with one corner more";
}

}  // namespace
}  // namespace mudline
