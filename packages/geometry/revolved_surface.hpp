#pragma once

#include "geometry/contour.hpp"
#include "geometry/surface.hpp"

namespace mudline {

/// A half contour of the plane (r, z) turned once around the z axis.
///
/// Points on the axis have the normal along it where the contour meets the axis nearest to them. Where the shaft is
/// nearest all round, the normal jumps across the axis; there, its direction is that of x.
class RevolvedSurface : public Surface {
 public:
  /// std::logic_error for a full contour.
  explicit RevolvedSurface(Contour contour);
  const Contour& contour() const { return contour_; }

  SurfaceProjection closest(const Point& x) const override;
  SurfaceTriangles triangles(double chord_error) const override;
  SolidMoments moments() const override;

 private:
  /// Whether the contour ends on the axis at its top too.
  bool closed() const;
  Contour contour_;
};

}  // namespace mudline
