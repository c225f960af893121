#pragma once

#include "geometry/surface.hpp"

namespace mudline {

/// A box around the origin, its sides along the axes, with all edges and corners rounded by one fillet radius: plates,
/// fins, wings.
///
/// A fillet radius of 0 makes sharp edges: outside, the normal fans out from them; on an edge it is the mean of its
/// sides. Inside, beyond the reach of the fillets, the nearest side counts: the normal jumps where two are equally
/// near.
class RoundedBox : public Surface {
 public:
  /// Lengths and fillet radius [m], which is at most half the shortest length.
  RoundedBox(const Point& lengths, double fillet_radius);

  SurfaceProjection closest(const Point& x) const override;
  SurfaceTriangles triangles(double chord_error) const override;
  SolidMoments moments() const override;

 private:
  Point core_;  // half lengths of the core: the box that becomes the body when it grows by the fillet radius
  double radius_;
};

}  // namespace mudline
