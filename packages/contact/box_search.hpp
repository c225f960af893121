#pragma once

#include <array>
#include <vector>

#include "framework/state.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// Boxes, sorted along the direction in which they spread most: finds those near another one.
class BoxSearch {
 public:
  using Corners = std::array<Point, 2>;  // [m] low, high; in the plane the third numbers are 0
  void sort(const std::vector<Corners>& boxes);
  /// Numbers of the boxes that come within `distance` [m] of the box, in ascending order.
  std::vector<int> near(const Corners& box, double distance) const;

 private:
  struct Box {
    Point low, high;
    int number;
  };
  std::vector<Box> boxes_;  // by low[along_]
  int along_ = 0;
  double longest_ = 0;  // [m] extent of a box in that direction
};

/// The box around the nodes of a side.
BoxSearch::Corners side_box(const int* node, int count, const ConstCoordinateView& x);

}  // namespace mudline
