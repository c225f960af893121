#include "ale/patch_plane.hpp"

#include <algorithm>
#include <cmath>

namespace mudline {

namespace {

constexpr double flatness = 1e-9;

}  // namespace

SharedCoordinates::SharedCoordinates(const Positions& places) {
  value = places.front();
  Point beside{};
  double extent = 0;
  for (const Point& place : places) {
    extent = std::max(extent, length(place - value));
    for (int d = 0; d < 3; ++d) beside[d] = std::max(beside[d], std::abs(place[d] - value[d]));
  }
  for (int d = 0; d < 3; ++d) shared[d] = beside[d] < flatness * extent;
}

Point SharedCoordinates::kept(Point at) const {
  for (int d = 0; d < 3; ++d)
    if (shared[d]) at[d] = value[d];
  return at;
}

PatchPlane::PatchPlane(const MeshSurfaces& surfaces, int patch, const Positions& x) {
  Positions places;
  Point sum{};
  for (int f : surfaces.patches[patch].faces) {
    const SurfaceFace& face = surfaces.faces[f];
    sum += face_normal(face, {0.3, 0.3}, x);
    for (int a = 0; a < num_nodes(face.shape); ++a) places.push_back(x[face.nodes[a]]);
  }
  normal = unit(sum);
  double extent = 0, off = 0;
  for (const Point& place : places) {
    const Point from = place - places.front();
    extent = std::max(extent, length(from));
    off = std::max(off, std::abs(dot(from, normal)));
  }
  flat = off < flatness * extent;
  of_all = SharedCoordinates(places);
}

}  // namespace mudline
