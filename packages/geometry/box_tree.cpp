#include "geometry/box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace mudline {

namespace {
constexpr int leaf_size = 2;
}  // namespace

BoxTree::BoxTree(const std::vector<Bounds>& boxes) : numbers_(boxes.size()) {
  std::iota(numbers_.begin(), numbers_.end(), 0);
  build(boxes, 0, static_cast<int>(boxes.size()));
}

void BoxTree::build(const std::vector<Bounds>& boxes, int first, int count) {
  const auto here = nodes_.size();
  Bounds box = Bounds::nothing(), centres = Bounds::nothing();
  const auto centre = [&](int number, int axis) { return boxes[number].low[axis] + boxes[number].high[axis]; };
  for (int i = first; i < first + count; ++i) {
    box.enclose(boxes[numbers_[i]].low);
    box.enclose(boxes[numbers_[i]].high);
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
  build(boxes, first, count / 2);
  nodes_[here].right = static_cast<int>(nodes_.size());
  build(boxes, first + count / 2, count - count / 2);
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
