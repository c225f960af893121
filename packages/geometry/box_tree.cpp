#include "geometry/box_tree.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace mudline {

namespace {
constexpr int leaf_size = 2;
}  // namespace

BoxTree::BoxTree(std::vector<Bounds> boxes) : boxes_(std::move(boxes)), numbers_(boxes_.size()) {
  std::iota(numbers_.begin(), numbers_.end(), 0);
  if (!boxes_.empty()) build(0, static_cast<int>(boxes_.size()));
}

void BoxTree::build(int first, int count) {
  const auto here = nodes_.size();
  Bounds box = Bounds::nothing(), centres = Bounds::nothing();
  const auto centre = [&](int number, int axis) { return boxes_[number].low[axis] + boxes_[number].high[axis]; };
  for (int i = first; i < first + count; ++i) {
    box.enclose(boxes_[numbers_[i]].low);
    box.enclose(boxes_[numbers_[i]].high);
    centres.enclose({centre(numbers_[i], 0), centre(numbers_[i], 1), centre(numbers_[i], 2)});
  }
  nodes_.push_back({box, first, count, -1});
  if (count <= leaf_size) return;
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (centres.high[i] - centres.low[i] > centres.high[axis] - centres.low[axis]) axis = i;
  const auto begin = numbers_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](int a, int b) {
    return centre(a, axis) != centre(b, axis) ? centre(a, axis) < centre(b, axis) : a < b;
  });
  nodes_[here].count = 0;
  build(first, count / 2);
  nodes_[here].right = static_cast<int>(nodes_.size());
  build(first + count / 2, count - count / 2);
}

std::vector<int> BoxTree::near(const Bounds& box, double distance) const {
  const auto apart = [&](const Bounds& other) {
    bool result = false;
    for (int i = 0; i < 3; ++i)
      result = result || other.low[i] > box.high[i] + distance || other.high[i] < box.low[i] - distance;
    return result;
  };
  std::vector<int> result, stack;
  if (!nodes_.empty()) stack.push_back(0);
  while (!stack.empty()) {
    const int at = stack.back();
    const Node& node = nodes_[at];
    stack.pop_back();
    if (apart(node.box)) continue;
    for (int i = node.first; i < node.first + node.count; ++i)
      if (!apart(boxes_[numbers_[i]])) result.push_back(numbers_[i]);
    if (node.count == 0) stack.insert(stack.end(), {node.right, at + 1});
  }
  std::sort(result.begin(), result.end());
  return result;
}

double BoxTree::square_distance(const Bounds& box, const Point& x) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double beyond = std::max({0.0, box.low[i] - x[i], x[i] - box.high[i]});
    sum += beyond * beyond;
  }
  return sum;
}

}  // namespace mudline
