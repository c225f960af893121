#pragma once

#include "discretisation/mesh.hpp"

namespace mudline {

/// A point of a patch and its derivatives with respect to the second (a) and the third (b) barycentric coordinate.
struct PatchPoint {
  Point x, da, db, daa, dab, dbb;  // [m]
};

/// A curved triangle through three points with given normals: the quartic of Walton and Meek (1996), whose inner
/// control points are blended as in Gregory's patch. Its edges and the normals along them depend on their two ends
/// only, so that neighbours have the same tangent planes there: together they are a surface without creases. Curvatures
/// jump at edges.
class SmoothPatch {
 public:
  /// Corners counter-clockwise as seen from where the normals, unit vectors, point, at less than 90 degrees to the
  /// facet's.
  SmoothPatch(const std::array<Point, 3>& corner, const std::array<Point, 3>& normal);

  PatchPoint at(double a, double b) const;
  /// Nearest point to x by Newton's method within the triangle, from the nearest point of the flat facet.
  PatchPoint closest(const Point& x) const;
  /// Distance [m] to the flat facet.
  double flat_distance(const Point& x) const;
  /// Bound of the distance [m] between the patch and the flat facet.
  double bulge() const { return bulge_; }
  Bounds bounds() const { return bounds_; }

 private:
  static constexpr int points = 15;
  /// Number of the control point with these exponents of the barycentric coordinates, whose sum is 4.
  static int number(const std::array<int, 3>& exponent) {
    const int rest = exponent[1] + exponent[2];
    return rest * (rest + 1) / 2 + exponent[2];
  }
  void set_edge(int edge, const std::array<Point, 3>& corner, const std::array<Point, 3>& normal);
  void set_inside(int edge, const std::array<Point, 3>& normal);
  /// Barycentric coordinates of the nearest point of the flat facet; the distance.
  double closest_flat(const Point& x, double& a, double& b) const;
  /// Nearest point to x by Newton's method from these barycentric coordinates.
  PatchPoint closest_from(const Point& x, double a, double b) const;

  std::array<Point, points> control_{};
  std::array<Point, 3> twist_{};  // difference of the two inner control points at every corner
  Point edge_a_, edge_b_;         // of the flat facet, from the first corner
  Bounds bounds_;
  double bulge_ = 0;
};

}  // namespace mudline
