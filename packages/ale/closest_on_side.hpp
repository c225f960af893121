#pragma once

#include "ale/ghosted_mesh.hpp"
#include "discretisation/side_map.hpp"

namespace mudline {

/// The map of a face of elements in space at one place. `nodes`: those of the face, in the order of the shape; `x`:
/// their places.
SideMap<3> face_map(CellShape shape, const int* nodes, const Positions& x, const Vec<double, 2>& place);

/// The closest point of a side of an element to a point.
struct ClosestOnSide {
  Vec<double, 2> place{};   // reference coordinates of the side; of a line the first
  double distance = 1e300;  // [m]
  bool inside = false;      // not at an end of the line or on an edge of the face
};

/// The closest point of a curved side to a point: of a line, or of a face of elements in space. `nodes`: those of the
/// side, in the order of the shape; `x`: their places. What is farther off than `least` [m] is found only roughly.
ClosestOnSide closest_on_side(CellShape shape, const int* nodes, const Positions& x, const Point& point,
                              double least = 1e300);

}  // namespace mudline
