#pragma once

#include "discretisation/mesh.hpp"
#include "geometry/solid_moments.hpp"
#include "geometry/surface_triangles.hpp"

namespace mudline {

/// What the surface of a body knows of one point of space.
struct SurfaceProjection {
  double gap;    // [m] signed distance; negative inside the body (penetration)
  Point normal;  // [-] unit, from the body into the soil; the gradient of the gap
  double turning[3]
                [3];  // [1/m] dn/dx, symmetric: the second derivative of the gap; 0 where the centre of a curvature is
  Point projection;   // [m] the nearest point of the surface
  int part;           // of a union, the one with the closest point; 0 of a surface without parts
};

/// The surface of a rigid body in space, in the body's own frame, whose z axis points up and is the axis of what is
/// revolved. Thread-safe: closest() keeps nothing.
///
/// The gap is continuous everywhere. Its gradient, the normal, is continuous outside a body without re-entrant edges,
/// and inside as far as only one point of the surface is nearest.
class Surface {
 public:
  virtual ~Surface() = default;
  virtual SurfaceProjection closest(const Point& x) const = 0;
  /// A box that holds the body; infinite where the body goes on for ever.
  const Bounds& bounds() const { return bounds_; }
  /// Triangles for output, within `chord_error` [m] of the surface; of a body that goes on for ever as far as it is
  /// drawn, and closed there.
  virtual SurfaceTriangles triangles(double chord_error) const = 0;
  /// Of what the surface encloses; all 0 of a body that goes on for ever.
  virtual SolidMoments moments() const = 0;

 protected:
  Bounds bounds_;
};

}  // namespace mudline
