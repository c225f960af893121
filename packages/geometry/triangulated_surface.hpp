#pragma once

#include <memory>
#include <vector>

#include "geometry/box_tree.hpp"
#include "geometry/smooth_patch.hpp"
#include "geometry/surface.hpp"

namespace mudline {

/// A closed surface of triangles, smoothed: a SmoothPatch on every facet, with the normals of point_normals(). The
/// surface goes through all points and has no creases, so that gap and normal are continuous; the turning, that of the
/// patches, jumps at their edges. Real edges of the body are smoothed too, over the facets beside them; largest_angle()
/// tells whether there are such edges.
class TriangulatedSurface : public Surface {
 public:
  /// Points that are within 1e-7 of the body's size of each other become one. A surface that is inside out is turned.
  /// InputError, without a position, for one that is not closed, see closed_edges(), or that is folded to an edge of no
  /// thickness.
  explicit TriangulatedSurface(const SurfaceTriangles& triangles);

  SurfaceProjection closest(const Point& x) const override;
  /// Triangles for output; all facets are cut alike.
  SurfaceTriangles triangles(double chord_error) const override;
  SolidMoments moments() const override;
  std::size_t facets() const { return patches_.size(); }
  /// Largest angle between the normals of neighbouring facets [rad].
  double largest_angle() const { return largest_angle_; }
  /// Bound of the distance between the surface and its facets [m].
  double largest_bulge() const { return largest_bulge_; }

 private:
  std::vector<SmoothPatch> patches_;
  std::unique_ptr<const BoxTree> tree_;
  double largest_angle_ = 0, largest_bulge_ = 0;
};

}  // namespace mudline
