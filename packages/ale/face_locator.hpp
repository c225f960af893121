#pragma once

#include <map>
#include <vector>

#include "ale/mesh_surfaces.hpp"
#include "ale/side_locator.hpp"

namespace mudline {

/// Finds closest points on a surface, which consists of its faces with their curvature.
class FaceLocator {
 public:
  /// Both arguments must outlive it.
  FaceLocator(const std::vector<SurfaceFace>& faces, const Positions& x);
  /// The closest point on the faces of a patch. `guess`: face to look at first; -1: none.
  SurfacePlace nearest(int patch, const Point& point, int guess = -1) const;
  /// Where the patch is met by the line through a point along the patch's normal. The point is near the patch: the
  /// middle of an edge, say.
  SurfacePlace over(int patch, const Point& point) const;
  /// The closest point on any face.
  SurfacePlace nearest(const Point& point) const;
  Point at(const SurfacePlace& place) const { return face_point(faces_[place.face], place.xi, x_); }
  /// Outward unit normal.
  Point normal(const SurfacePlace& place) const { return unit(face_normal(faces_[place.face], place.xi, x_)); }

 private:
  /// The faces of a patch.
  struct Patch {
    std::vector<int> faces;
    SideLocator locator;
  };

  const std::vector<SurfaceFace>& faces_;
  const Positions& x_;
  std::map<int, Patch> patches_;
};

}  // namespace mudline
