#pragma once

#include <memory>
#include <vector>

#include "geometry/surface.hpp"
#include "tensor/rotation.hpp"

namespace mudline {

/// A surface placed in another frame: rotated about its own origin, which is then shifted to `position`.
struct PlacedSurface {
  std::shared_ptr<const Surface> surface;
  Point position{};  // [m]
  Rotation rotation{};

  Point to_frame(const Point& x) const { return rotation.back(x - position); }
  Point from_frame(const Point& x) const { return position + rotation(x); }
  /// Closest point of the surface; x and the result are in the other frame.
  SurfaceProjection closest(const Point& x) const;
  Bounds bounds() const;
};

/// A body of parts that may overlap, as fins that run into a hull: the part with the smallest gap counts.
///
/// Outside this is the distance. The normal jumps where two parts are equally near: along the re-entrant edges at which
/// they meet, and on surfaces that go out from there. Inside, the part counts in which the point is deepest, which may
/// have its closest point within another part: the gap is then smaller than the distance to the surface of the whole.
class SurfaceUnion : public Surface {
 public:
  /// At least one part is needed.
  explicit SurfaceUnion(std::vector<PlacedSurface> parts);
  const std::vector<PlacedSurface>& parts() const { return parts_; }

  SurfaceProjection closest(const Point& x) const override;
  /// Triangles of all parts, also where these lie inside each other.
  SurfaceTriangles triangles(double chord_error) const override;
  /// Exact except for the overlap of parts, which is summed over up to 2e5 blocks to about 1 in 500.
  SolidMoments moments() const override;

 private:
  struct Block {
    Point low, high;
    int cuts;  // how often the block may still be halved
  };
  /// Adds the overlap of the part with those before it, within the block; all in the part's frame.
  void add_common(int part, const Block& block, SolidMoments& sum) const;
  std::vector<PlacedSurface> parts_;
};

}  // namespace mudline
