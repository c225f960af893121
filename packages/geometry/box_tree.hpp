#pragma once

#include <vector>

#include "discretisation/mesh.hpp"

namespace mudline {

/// Binary tree of boxes in space, to search for near ones. Branches are halved at the median of the centres along the
/// longest side.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::vector<Bounds> boxes);

  /// Numbers of the boxes that come within `distance` [m] of a box in every direction, in ascending order.
  std::vector<int> near(const Bounds& box, double distance) const;

  /// Calls visit(number) for the boxes that are nearer to x than the root of `square` [m2], which visit() lowers. The
  /// nearer half comes first.
  template <class Visit>
  void search(const Point& x, const double& square, const Visit& visit) const {
    int stack[2 * max_depth], count = 0;
    if (!nodes_.empty()) stack[count++] = 0;
    while (count > 0) {
      const Node& node = nodes_[stack[--count]];
      if (!(square_distance(node.box, x) < square)) continue;
      if (node.count > 0) {
        for (int i = 0; i < node.count; ++i) visit(numbers_[node.first + i]);
        continue;
      }
      const int left = static_cast<int>(&node - nodes_.data()) + 1;
      const bool left_first = square_distance(nodes_[left].box, x) <= square_distance(nodes_[node.right].box, x);
      stack[count++] = left_first ? node.right : left;
      stack[count++] = left_first ? left : node.right;
    }
  }

 private:
  static constexpr int max_depth = 64;
  struct Node {
    Bounds box;
    int first, count;  // of a leaf: its range in numbers_
    int right;         // of a branch: its right half; the left one is the next node
  };
  static double square_distance(const Bounds& box, const Point& x);
  void build(int first, int count);

  std::vector<Bounds> boxes_;
  std::vector<Node> nodes_;  // none without boxes
  std::vector<int> numbers_;
};

}  // namespace mudline
