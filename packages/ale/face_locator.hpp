#pragma once

#include <map>
#include <vector>

#include "ale/face_place.hpp"
#include "ale/mesh_surfaces.hpp"

namespace mudline {

/// Finds the places on a surface that are nearest to points; the surface is that of its faces, curved as they are.
class FaceLocator {
 public:
  /// Both outlive it.
  FaceLocator(const std::vector<SurfaceFace>& faces, const Positions& x);
  /// On the faces of a patch. `guess`: face to look at first; -1: none.
  SurfacePlace nearest(int patch, const Point& point, int guess = -1) const;
  /// Where the normal of the patch's surface through a point near it meets it: the point is the middle of an edge, say.
  SurfacePlace over(int patch, const Point& point) const;
  /// On any face.
  SurfacePlace nearest(const Point& point) const;
  Point at(const SurfacePlace& place) const { return face_point(faces_[place.face], place.xi, x_); }
  /// Outwards, of length 1.
  Point normal(const SurfacePlace& place) const { return unit(face_normal(faces_[place.face], place.xi, x_)); }

 private:
  /// No part of the face is outside.
  struct Ball {
    int face;
    Point centre;
    double radius;
  };
  struct Nearest {
    SurfacePlace place;
    double distance = 1e300;
  };
  void look(const std::vector<Ball>& balls, const Point& point, Nearest& best) const;

  const std::vector<SurfaceFace>& faces_;
  const Positions& x_;
  std::map<int, std::vector<Ball>> balls_;  // by patch
};

}  // namespace mudline
