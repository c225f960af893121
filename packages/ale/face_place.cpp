#include "ale/face_place.hpp"

#include <algorithm>
#include <cmath>

#include "ale/mesh_surfaces.hpp"
#include "discretisation/element_map.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

constexpr double rounding = 1e-14;

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

/// The step in reference coordinates towards a point, by the Gauss-Newton method: faces are nearly flat.
FacePlace step_towards(const FaceMap& map, const Point& point) {
  const Point off = point - map.at;
  const double a = dot(map.along[0], map.along[0]), b = dot(map.along[0], map.along[1]),
               c = dot(map.along[1], map.along[1]);
  const double p = dot(map.along[0], off), q = dot(map.along[1], off), det = a * c - b * b;
  if (!(det > 0)) return {0, 0};
  return {(c * p - b * q) / det, (a * q - b * p) / det};
}

/// Place on an edge, at the share [0, 1] of its length from the first corner.
FacePlace on_edge(const SurfaceFace& face, int edge, double share) {
  const auto ends = edge_corners(face.shape, edge);
  const auto a = reference_node(face.shape, ends[0]), b = reference_node(face.shape, ends[1]);
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
}

double nearest_share(const SurfaceFace& face, int edge, const Point& point, const Positions& x) {
  const auto ends = edge_corners(face.shape, edge);
  const auto a = reference_node(face.shape, ends[0]), b = reference_node(face.shape, ends[1]);
  double share = 0.5;
  for (int k = 0; k < 30; ++k) {
    const FaceMap map(face, on_edge(face, edge, share), x);
    const Point tangent = (b[0] - a[0]) * map.along[0] + (b[1] - a[1]) * map.along[1];
    const double square = dot(tangent, tangent);
    if (!(square > 0)) break;
    const double next = std::clamp(share + dot(tangent, point - map.at) / square, 0.0, 1.0);
    const bool done = std::abs(next - share) < rounding;
    share = next;
    if (done) break;
  }
  return share;
}

}  // namespace

Point face_point(const SurfaceFace& face, const FacePlace& place, const Positions& x) {
  return FaceMap(face, place, x).at;
}

Point face_normal(const SurfaceFace& face, const FacePlace& place, const Positions& x) {
  const FaceMap map(face, place, x);
  return cross(map.along[0], map.along[1]);
}

NearestOnFace nearest_on_face(const SurfaceFace& face, const Point& point, const Positions& x) {
  const auto centre = cell_centre(face.shape);
  NearestOnFace best{{centre[0], centre[1]}, 1e300, false};
  FacePlace place = best.place;
  for (int k = 0; k < 30; ++k) {
    const FacePlace step = step_towards(FaceMap(face, place, x), point);
    for (int i = 0; i < 2; ++i) place[i] += step[i];
    if (!(outside_cell(face.shape, place.data()) < 0.5)) break;  // the closest point is on another face
    if (std::abs(step[0]) + std::abs(step[1]) > rounding) continue;
    break;
  }
  if (outside_cell(face.shape, place.data()) <= 0) return {place, length(point - face_point(face, place, x)), true};
  for (int edge = 0; edge < num_edges(face.shape); ++edge) {
    const FacePlace there = on_edge(face, edge, nearest_share(face, edge, point, x));
    const double distance = length(point - face_point(face, there, x));
    if (distance < best.distance) best = {there, distance, false};
  }
  return best;
}

}  // namespace mudline
