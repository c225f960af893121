#pragma once

#include "discretisation/mesh.hpp"
#include "geometry/solid_moments.hpp"
#include "geometry/surface_triangles.hpp"
#include "tensor/mat.hpp"

namespace mudline {

/// Closest point of a body's surface to a point of space, with the gap and its derivatives.
struct SurfaceProjection {
  double gap;              // [m] signed distance; negative inside the body (penetration)
  Point normal;            // [-] unit, from the body into the soil; the gradient of the gap
  Mat<double, 3> turning;  // [1/m] dn/dx, symmetric: the second derivative of the gap; 0 at a centre of curvature
  Point point;             // [m] the nearest point of the surface
  int part;                // part of a union with the closest point; 0 for a surface without parts
};

/// The surface of a rigid body in space, in the body's own frame, whose z axis points up and is the axis of a revolved
/// surface. Thread-safe: closest() stores nothing.
///
/// The gap is continuous everywhere. Its gradient, the normal, is continuous outside a body without re-entrant edges,
/// and inside wherever only one point of the surface is nearest.
class Surface {
 public:
  virtual ~Surface() = default;
  virtual SurfaceProjection closest(const Point& x) const = 0;
  /// A box that holds the body; infinite where the body goes on for ever.
  const Bounds& bounds() const { return bounds_; }
  /// Triangles for output, within `chord_error` [m] of the surface. A body that goes on for ever is cut off and closed
  /// where its drawing ends.
  virtual SurfaceTriangles triangles(double chord_error) const = 0;
  /// Moments of the enclosed solid; all 0 for a body that goes on for ever.
  virtual SolidMoments moments() const = 0;

 protected:
  Bounds bounds_;
};

}  // namespace mudline
