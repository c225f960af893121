#pragma once

#include "ale/closest_on_side.hpp"
#include "tensor/vec.hpp"

namespace mudline {

struct SurfaceFace;

/// Reference coordinates of a point of a face.
using FacePlace = Vec<double, 2>;

/// A place on a face of a mesh's surfaces.
struct SurfacePlace {
  int face = -1;
  FacePlace xi{};
};

/// [m]
Point face_point(const SurfaceFace& face, const FacePlace& place, const Positions& x);
/// Outward normal, whose length is the area per reference area [m2].
Point face_normal(const SurfaceFace& face, const FacePlace& place, const Positions& x);

/// Place of a mid-side node, moved back along the normal until it bulges by no more than a tenth of the edge [m] from
/// the centre of its ends: an edge across a sharp ridge of the surface, as the lip beside a body, would fold the
/// element behind it.
inline Point without_bulge(const Point& at, const Point& centre, const Point& normal, double edge) {
  const double excess = dot(at - centre, normal) - 0.1 * edge;
  return excess > 0 ? at - excess * normal : at;
}

/// The closest point of a face of the mesh's surfaces.
ClosestOnSide closest_on_side(const SurfaceFace& face, const Positions& x, const Point& point, double least = 1e300);

}  // namespace mudline
