#pragma once

#include <algorithm>

#include "ale/ghosted_mesh.hpp"
#include "tensor/vec.hpp"

namespace mudline {

struct SurfaceFace;

/// Where a point of a face is: reference coordinates of the face's shape.
using FacePlace = Vec<double, 2>;

/// A place on a face of a mesh's surfaces.
struct SurfacePlace {
  int face = -1;
  FacePlace xi{};
};

/// [m]
Point face_point(const SurfaceFace& face, const FacePlace& place, const Positions& x);
/// Outwards, as long as the area per reference area [m2].
Point face_normal(const SurfaceFace& face, const FacePlace& place, const Positions& x);

/// Of length 1; what has no length stays.
inline Point unit(const Point& a) { return 1 / std::max(length(a), 1e-300) * a; }

/// A middle of an edge no farther off the centre of its ends, outwards, than a tenth of the edge [m]: what straddles a
/// sharp ridge of the surface, as the lip beside a body, would fold the element behind it.
inline Point without_bulge(const Point& at, const Point& centre, const Point& normal, double edge) {
  const double excess = dot(at - centre, normal) - 0.1 * edge;
  return excess > 0 ? at - excess * normal : at;
}

/// The point of a face, curved as it is, that is nearest to another.
struct NearestOnFace {
  FacePlace place;
  double distance;  // [m]
  bool inside;      // not on an edge of the face
};
NearestOnFace nearest_on_face(const SurfaceFace& face, const Point& point, const Positions& x);

}  // namespace mudline
