#pragma once

#include <vector>

#include "discretisation/mesh.hpp"
#include "framework/state.hpp"

namespace mudline {

/// Finds the boxes near another one. The boxes are sorted along the direction in which they spread most.
class BoxSearch {
 public:
  void sort(const std::vector<Bounds>& boxes);
  /// Numbers of the boxes that come within `distance` [m] of the box, in ascending order.
  std::vector<int> near(const Bounds& box, double distance) const;

 private:
  struct Box {
    Bounds at;
    int number;
  };
  std::vector<Box> boxes_;  // sorted by low[along_]
  int along_ = 0;
  double longest_ = 0;  // [m] largest extent of a box in that direction
};

/// The box around the nodes of a side.
Bounds side_box(const int* node, int count, const ConstCoordinateView& x);

}  // namespace mudline
