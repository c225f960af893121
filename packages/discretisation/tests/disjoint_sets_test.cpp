#include "discretisation/disjoint_sets.hpp"

#include <gtest/gtest.h>

namespace mudline {
namespace {

TEST(DisjointSets, AreLedByTheirLowestNumberInWhateverOrderTheyAreJoined) {
  DisjointSets sets(7);
  sets.join(5, 3);
  sets.join(6, 5);
  sets.join(2, 0);
  sets.join(6, 3);  // once more
  EXPECT_EQ(sets.leader(6), 3);
  EXPECT_EQ(sets.leaders(), (std::vector<int>{0, 1, 0, 3, 4, 3, 3}));
  sets.join(6, 2);
  EXPECT_EQ(sets.leaders(), (std::vector<int>{0, 1, 0, 0, 4, 0, 0}));
}

}  // namespace
}  // namespace mudline
