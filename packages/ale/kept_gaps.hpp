#pragma once

#include <functional>
#include <map>
#include <optional>

#include "ale/face_place.hpp"
#include "ale/mesh_surfaces.hpp"

namespace mudline {

/// Of the body that is nearest to a point.
struct NearBody {
  double gap;    // [m]
  Point normal;  // from the body into the soil
};
using BodySearch = std::function<std::optional<NearBody>(const Point&)>;

/// Keeps the gaps between a surface and bodies where the surface gets other nodes, so that contact pressures are not
/// disturbed.
class KeptGaps {
 public:
  /// `x`: of the surface's nodes. All outlive it.
  KeptGaps(const BodySearch& body, const Positions& x) : body_(body), x_(x) {}
  /// A node that comes to `at`, a place on a face: as far from the body as the nodes of the face say for there, within
  /// what they have. As it is where it is farther from the body than a quarter of `span`, the edge beside it [m].
  Point kept(const SurfaceFace& face, const FacePlace& place, const Point& at, double span);

 private:
  const BodySearch& body_;
  const Positions& x_;
  std::map<int, double> gaps_;  // of nodes [m]
};

}  // namespace mudline
