#include "contact/faces/master_faces.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "tensor/vec.hpp"

namespace mudline {

MasterFaces::MasterFaces(const Mesh& mesh, const std::string& side_set, double corner_angle)
    : DeformableTarget(3),
      surface_(mesh, side_set),
      around_(surface_.sides().size()),
      normals_(surface_.sides().size()) {
  const ConstCoordinateView x = mesh.coordinates();
  std::map<int, std::vector<Corner>> meeting;  // by mesh node
  for (int f = 0; f < pieces(); ++f)
    for (int a = 0; a < surface_.sides()[f].count; ++a) meeting[surface_.sides()[f].node[a]].push_back({f, a});
  const double least = std::cos(corner_angle);
  for (int f = 0; f < pieces(); ++f) {
    const auto& side = surface_.sides()[f];
    around_[f].resize(side.count);
    for (int a = 0; a < side.count; ++a) {
      const Point own = normal_at(f, a, x);
      for (const Corner& other : meeting[side.node[a]]) {
        const Point there = normal_at(other.face, other.node, x);
        if (dot(own, there) >= least * length(own) * length(there)) around_[f][a].push_back(other);
      }
    }
  }
  update(x);
}

/// Normal at a node of a face, with the length of the area per reference area.
Point MasterFaces::normal_at(int face, int node, const ConstCoordinateView& x) const {
  const auto& side = surface_.sides()[face];
  const auto xi = reference_node(side.shape, node);
  double N[max_side_nodes], dN[2 * max_side_nodes];
  evaluate_shape(side.shape, xi.data(), N, dN);
  Point along[2] = {};
  for (int a = 0; a < side.count; ++a)
    for (int k = 0; k < 2; ++k) along[k] += dN[2 * a + k] * place_of(x, side.node[a]);
  return cross(along[0], along[1]);
}

void MasterFaces::update(const ConstCoordinateView& x) {
  surface_.update(x);
  for (int f = 0; f < pieces(); ++f)
    for (int a = 0; a < surface_.sides()[f].count; ++a) {
      Point sum{};
      for (const Corner& at : around_[f][a]) sum += unit(normal_at(at.face, at.node, x));
      normals_[f][a] = unit(sum);
    }
}

MasterFace MasterFaces::face(int index, const ConstCoordinateView& x) const {
  const auto& side = surface_.sides()[index];
  return {side.shape, side.count, side_coordinates(side, x), normals_[index]};
}

bool MasterFaces::find(const std::vector<int>& candidates, const Point& at, const Point& outward, double capture,
                       const ConstCoordinateView& x, TargetPlace& place) const {
  double nearest = capture;
  bool found = false;
  for (int candidate : candidates) {
    const MasterFace there = face(candidate, x);
    const Bounds box = side_box(surface_.sides()[candidate].node, there.count, x);
    bool apart = false;
    for (int i = 0; i < 3; ++i) apart = apart || at[i] < box.low[i] - nearest || at[i] > box.high[i] + nearest;
    TargetPlace here;
    if (apart || !find_projection(there, at, here) || std::abs(here.gap) > nearest) continue;
    if (found && std::abs(here.gap) == nearest) continue;
    if (dot(face_normal(there, here), outward) >= 0) continue;  // back to back
    nearest = std::abs(here.gap);
    place = here;
    place.piece = candidate;
    found = true;
  }
  return found;
}

void MasterFaces::weights(int piece, const double* at, double* weight) const {
  double dN[2 * max_side_nodes];
  evaluate_shape(sides()[piece].shape, at, weight, dN);
}

}  // namespace mudline
