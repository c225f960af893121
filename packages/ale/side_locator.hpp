#pragma once

#include <vector>

#include "ale/closest_on_side.hpp"
#include "geometry/box_tree.hpp"

namespace mudline {

/// Finds the closest point on sides of elements, which are curved.
class SideLocator {
 public:
  /// The closest point found so far.
  struct Place {
    int side = -1;  // its number; -1: none
    FacePlace xi{};
    double distance = 1e300;  // [m]
  };

  /// `x`: all nodes' positions, which must outlive it.
  SideLocator(std::vector<CurvedSide> sides, const Positions& x);
  /// Puts the closest point on the sides into `best` if it is closer than that. Of sides that are equally close it is
  /// the first.
  void approach(const Point& point, Place& best) const;
  /// Looks at one side alone.
  void approach(int side, const Point& point, Place& best) const;

 private:
  std::vector<CurvedSide> sides_;
  const Positions& x_;
  BoxTree boxes_;
};

}  // namespace mudline
