#pragma once

#include <array>

#include "ale/ghosted_mesh.hpp"
#include "discretisation/side_map.hpp"

namespace mudline {

/// A side of an element, with its curvature: a line, or a face in space.
struct CurvedSide {
  CellShape shape;
  std::array<int, 9> nodes;  // in the order of the shape; of a face as seen from outside
};

/// Reference coordinates of a point of a side; of a line the first.
using FacePlace = Vec<double, 2>;

/// A place on a face of a mesh's surfaces.
struct SurfacePlace {
  int face = -1;
  FacePlace xi{};
};

// `x`: places of the nodes.

/// The map of a face at one place.
SideMap<3> face_map(const CurvedSide& face, const Positions& x, const FacePlace& place);
/// [m]
inline Point face_point(const CurvedSide& face, const FacePlace& place, const Positions& x) {
  return face_map(face, x, place).x;
}
/// Outward normal, whose length is the area per reference area [m2].
inline Point face_normal(const CurvedSide& face, const FacePlace& place, const Positions& x) {
  return face_map(face, x, place).normal;
}

/// Place of a mid-side node, moved back along the normal until it bulges by no more than a tenth of the edge [m] from
/// the centre of its ends: an edge across a sharp ridge of the surface, as the lip beside a body, would fold the
/// element behind it.
inline Point without_bulge(const Point& at, const Point& centre, const Point& normal, double edge) {
  const double excess = dot(at - centre, normal) - 0.1 * edge;
  return excess > 0 ? at - excess * normal : at;
}

/// The closest point of a side to a point.
struct ClosestOnSide {
  FacePlace place{};
  double distance = 1e300;  // [m]
  bool inside = false;      // not at an end of the line or on an edge of the face
};

/// The closest point of a side to a point. What is farther off than `least` [m] is found only roughly.
ClosestOnSide closest_on_side(const CurvedSide& side, const Positions& x, const Point& point, double least = 1e300);

}  // namespace mudline
