#pragma once

#include <algorithm>
#include <vector>

#include "ale/ghosted_mesh.hpp"

namespace mudline {

/// Size field [m] from the sides of the boundary: the length of a side beside it, growing with the distance from it.
class SizeAround {
 public:
  /// `growth`: increase of the size per distance [-].
  explicit SizeAround(double growth) : growth_(growth) {}
  /// Adds a side by its middle and length [m].
  void add(const Point& middle, double length) { sides_.push_back({middle, length}); }
  double operator()(const Point& x) const {
    double size = 1e300;
    for (const Side& side : sides_) {
      const double off = std::max(0.0, distance(x, side.middle) - 0.5 * side.length);
      size = std::min(size, side.length + growth_ * off);
    }
    return size;
  }

 private:
  struct Side {
    Point middle;
    double length;
  };
  double growth_;
  std::vector<Side> sides_;
};

}  // namespace mudline
