#include "ale/face_place.hpp"

#include "ale/mesh_surfaces.hpp"

namespace mudline {

Point face_point(const SurfaceFace& face, const FacePlace& place, const Positions& x) {
  return FaceMap(face.shape, face.nodes.data(), x, place).at;
}

Point face_normal(const SurfaceFace& face, const FacePlace& place, const Positions& x) {
  const FaceMap map(face.shape, face.nodes.data(), x, place);
  return cross(map.along[0], map.along[1]);
}

ClosestOnSide closest_on_side(const SurfaceFace& face, const Positions& x, const Point& point, double least) {
  return closest_on_side(face.shape, face.nodes.data(), x, point, least);
}

}  // namespace mudline
