#include "geometry/box_tree.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mudline {

namespace {

/// Flat boxes of all sizes in a unit cube.
std::vector<Bounds> random_boxes(int count) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> number(0, 1);
  std::vector<Bounds> boxes;
  for (int k = 0; k < count; ++k) {
    Bounds box = Bounds::nothing();
    for (int corner = 0; corner < 2; ++corner)
      box.enclose({number(engine), 0.7 * number(engine), k % 3 == 0 ? 0.5 : number(engine)});
    const Point middle = 0.5 * (box.low + box.high);
    box.low = middle + 0.1 * (box.low - middle);
    box.high = middle + 0.1 * (box.high - middle);
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace

TEST(BoxTree, FindsTheBoxesNearABoxInAscendingOrder) {
  const std::vector<Bounds> boxes = random_boxes(200);
  const BoxTree tree(boxes);
  std::size_t most = 0;
  for (const Bounds& around : random_boxes(40))
    for (const double distance : {0.0, 0.07, 3.0}) {
      std::vector<int> expected;
      for (int k = 0; k < static_cast<int>(boxes.size()); ++k) {
        bool near = true;
        for (int i = 0; i < 3; ++i)
          near = near && boxes[k].low[i] <= around.high[i] + distance && boxes[k].high[i] >= around.low[i] - distance;
        if (near) expected.push_back(k);
      }
      EXPECT_EQ(tree.near(around, distance), expected);
      most = std::max(most, distance < 1 ? expected.size() : 0);
    }
  EXPECT_GT(most, 3u);
  EXPECT_TRUE(BoxTree().near(boxes.front(), 1.0).empty());
  EXPECT_TRUE(BoxTree(std::vector<Bounds>{}).near(boxes.front(), 1.0).empty());
}

}  // namespace mudline
