#pragma once

#include <memory>
#include <vector>

#include "geometry/contour_piece.hpp"

namespace mudline {

/// Closest point of a contour to a point of the plane, with the gap and its derivatives.
struct ContourProjection {
  double gap;          // [m] signed distance; negative inside the body (penetration)
  PlanePoint normal;   // [-] unit, from the body into the soil; the gradient of the gap
  PlanePoint tangent;  // [-] unit, the normal turned counter-clockwise: the direction of travel
  double
      curvature;   // kappa [1/m] of the contour at the closest point, positive where the body is convex; 0 at a corner
  double turning;  // [1/m] dn/dx = turning (t (x) t): kappa / (1 + kappa gap), and 1 / gap at a corner
  PlanePoint point;   // [m] the nearest point of the contour
  int piece;          // the piece that the closest point lies on
  double arc_length;  // [m] of the closest point from the contour's start
  double travel;      // d arc_length / dx = travel t: 1 / (1 + kappa gap), and 0 at a corner
};

/// Part of the plane that a contour describes. half: the body is symmetric about x = 0, the contour starts on that axis
/// and only x >= 0 exists (axisymmetry, plane strain with a plane of symmetry). full: both sides.
enum class ContourExtent { half, full };

/// The outline of a rigid body in its own frame: pieces joined end to end, body on the left of the direction of travel,
/// for a half contour from the tip on the axis up along the flank and the shaft.
///
/// Corners (joints where the normal jumps) are allowed. Where the nearest point is a corner, i.e. in the fan outside a
/// convex corner and in the one inside a re-entrant corner, the normal is the direction from the corner (gap and normal
/// are continuous there); at the corner itself it is the mean of both sides. Inside a convex corner the nearer side
/// counts: the normal jumps across the bisector, which is why contact bodies want fillets.
class Contour {
 public:
  /// std::logic_error unless the pieces join.
  Contour(std::vector<std::shared_ptr<const ContourPiece>> pieces, ContourExtent extent);

  ContourProjection closest(const PlanePoint& x) const;
  ContourExtent extent() const { return extent_; }
  const std::vector<std::shared_ptr<const ContourPiece>>& pieces() const { return pieces_; }
  double length() const { return start_.back(); }
  /// Signed distance along the contour between two closest points [m]; the shorter way round where the contour is
  /// closed.
  double distance(const ContourProjection& from, const ContourProjection& to) const;
  /// Polyline for output whose chords stay within `chord_error` [m] of the contour.
  std::vector<PlanePoint> sample(double chord_error) const;
  /// The full contour made of a half contour and its mirror image.
  Contour mirrored() const;

 private:
  /// Normal of the neighbour that shares the end (0: start, 1: end) of a piece; false where there is none.
  bool neighbour_normal(int piece, int end, PlanePoint& normal) const;

  std::vector<std::shared_ptr<const ContourPiece>> pieces_;
  std::vector<double> start_;  // arc length at which each piece starts; one more: the whole length
  ContourExtent extent_;
  bool closed_ = false;  // a full contour whose ends meet
  double size_ = 0;      // [m] scale of the tolerances
};

/// Polygon through `points` with every corner rounded by its fillet radius [m] (0: sharp). On a half contour the first
/// corner, on the axis, is the one between the contour and its mirror image: its arc starts on the axis, above the
/// given point. The first and the last straight line continue for ever where the contour is open. Precondition:
/// overfull_line() is -1 for these arguments.
Contour rounded_polygon(const std::vector<PlanePoint>& points, const std::vector<double>& fillet_radii,
                        ContourExtent extent);

/// Index of the first line that is shorter than the fillets at its ends need; -1: all fit.
int overfull_line(const std::vector<PlanePoint>& points, const std::vector<double>& fillet_radii, ContourExtent extent);

}  // namespace mudline
