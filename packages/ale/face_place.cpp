#include "ale/face_place.hpp"

#include "ale/mesh_surfaces.hpp"

namespace mudline {

Point face_point(const SurfaceFace& face, const FacePlace& place, const Positions& x) {
  return face_map(face.shape, face.nodes.data(), x, place).x;
}

Point face_normal(const SurfaceFace& face, const FacePlace& place, const Positions& x) {
  return face_map(face.shape, face.nodes.data(), x, place).normal;
}

ClosestOnSide closest_on_side(const SurfaceFace& face, const Positions& x, const Point& point, double least) {
  return closest_on_side(face.shape, face.nodes.data(), x, point, least);
}

}  // namespace mudline
