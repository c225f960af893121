#pragma once

#include <map>
#include <utility>
#include <vector>

#include "contact/contact_rule.hpp"
#include "contact/contact_surface.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// Displacements of points along their side relative to the material (ALE), and the convection of a history f at these
/// points: f + (s_new - s_old) . grad f with the gradient of f along the side, in space in its two directions.
class SideShifts {
 public:
  /// The points were at `from` and are at `to` [m], on a side whose nodes were at `nodes`.
  SideShifts(const std::vector<Point>& from, const std::vector<Point>& to, CellShape side,
             const SideCoordinates& nodes);
  /// The points are the side's nodes.
  SideShifts(const SurfaceSide& side, const ConstCoordinateView& from, const ConstCoordinateView& to);
  /// Convects one column of the points' rows, which start at the row `first`.
  void convect(const PointView& rows, int first, int column) const;

 private:
  using Along = Vec<double, 2>;  // [m] in the side's directions; in the plane the second is 0
  void measure(const std::vector<Point>& from, const std::vector<Point>& to, CellShape side,
               const SideCoordinates& nodes);
  /// Gradient of values along the side by least squares.
  Along slope(const std::vector<double>& values) const;
  std::vector<Along> at_, shift_;
};

/// Convects (array, column) pairs of the committed state whose rows are the points of the sides, one side after the
/// other, when the nodes have been moved from x_old to the committed coordinates.
void convect_rows(const std::vector<SurfaceSide>& sides, const std::map<CellShape, ContactRule>& rules,
                  const ConstCoordinateView& x_old, const State& committed,
                  const std::vector<std::pair<int, int>>& columns);

}  // namespace mudline
