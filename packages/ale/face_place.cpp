#include "ale/face_place.hpp"

#include "ale/mesh_surfaces.hpp"
#include "discretisation/element_map.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// Position and tangents of a face at one place.
struct FaceMap {
  Point at{}, along[2] = {};
  FaceMap(const SurfaceFace& face, const FacePlace& place, const Positions& x) {
    double N[9], dN[18];
    evaluate_shape(face.shape, place.data(), N, dN);
    for (int a = 0; a < num_nodes(face.shape); ++a) {
      at += N[a] * x[face.nodes[a]];
      for (int k = 0; k < 2; ++k) along[k] += dN[2 * a + k] * x[face.nodes[a]];
    }
  }
};

}  // namespace

Point face_point(const SurfaceFace& face, const FacePlace& place, const Positions& x) {
  return FaceMap(face, place, x).at;
}

Point face_normal(const SurfaceFace& face, const FacePlace& place, const Positions& x) {
  const FaceMap map(face, place, x);
  return cross(map.along[0], map.along[1]);
}

ClosestOnSide closest_on_side(const SurfaceFace& face, const Positions& x, const Point& point, double least) {
  return closest_on_side(face.shape, face.nodes.data(), x, point, least);
}

}  // namespace mudline
