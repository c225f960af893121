#pragma once

#include <memory>
#include <vector>

#include "geometry/surface.hpp"
#include "tensor/rotation.hpp"

namespace mudline {

/// A surface where it stands in another frame: turned about its own origin, which is then shifted to `position`.
struct PlacedSurface {
  std::shared_ptr<const Surface> surface;
  Point position{};  // [m]
  Rotation rotation{};

  Point to_frame(const Point& x) const { return rotation.back(x - position); }
  Point from_frame(const Point& x) const { return position + rotation(x); }
  /// Of the surface, in the other frame.
  SurfaceFoot closest(const Point& x) const;
  Bounds bounds() const;
};

/// A body of parts that may overlap, as fins that run into a hull: the part with the smallest gap counts.
///
/// Outside this is the distance. The normal jumps where two parts are equally near: along the re-entrant edges at which
/// they meet, and on surfaces that go out from there. Inside, the part counts in which the point is deepest, which may
/// have its foot within another part: the gap is then smaller than the distance to the surface of the whole.
class SurfaceUnion : public Surface {
 public:
  /// At least one.
  explicit SurfaceUnion(std::vector<PlacedSurface> parts);
  const std::vector<PlacedSurface>& parts() const { return parts_; }

  SurfaceFoot closest(const Point& x) const override;
  /// Those of all parts, also where they run inside of each other.
  SurfaceTriangles triangles(double chord_error) const override;
  /// Exact but for what parts have in common, which is summed over up to 2e5 blocks to about 1 in 500.
  SolidMoments moments() const override;

 private:
  struct Block {
    Point low, high;
    int cuts;  // of the part's box that it still may be cut
  };
  /// Adds what the part has in common with those before it, within the block; all in the part's frame.
  void add_common(int part, const Block& block, SolidMoments& sum) const;
  std::vector<PlacedSurface> parts_;
};

}  // namespace mudline
