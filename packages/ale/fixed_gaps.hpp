#pragma once

#include <functional>
#include <map>
#include <optional>

#include "ale/mesh_surfaces.hpp"

namespace mudline {

/// Gap and normal of the body that is nearest to a point.
struct NearBody {
  double gap;    // [m]
  Point normal;  // from the body into the soil
};
using BodySearch = std::function<std::optional<NearBody>(const Point&)>;

/// Keeps the gaps between a surface and bodies where nodes of the surface move, so that contact pressures are not
/// disturbed.
class FixedGaps {
 public:
  /// `x`: positions of the surface's nodes. All arguments must outlive it.
  FixedGaps(const BodySearch& body, const Positions& x) : body_(body), x_(x) {}
  /// Place for a node that moves to `at`, a point of a face: its gap to the body is interpolated from the nodes of the
  /// face, within their range. The result is `at` where that gap exceeds a quarter of `span`, the edge beside it [m].
  Point kept(const SurfaceFace& face, const FacePlace& place, const Point& at, double span);

 private:
  const BodySearch& body_;
  const Positions& x_;
  std::map<int, double> gaps_;  // (node) [m]
};

}  // namespace mudline
