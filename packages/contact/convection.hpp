#pragma once

#include <vector>

#include "contact/contact_rule.hpp"
#include "contact/contact_surface.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// How far points of a side were moved along it under the material (ALE), and what becomes of a history that they
/// carry: f + (s_new - s_old) . grad f with the slope of f along the side, in space in its two directions.
class SideShifts {
 public:
  /// Points that were at `from` and are at `to` [m], on a side whose nodes were at `nodes`.
  SideShifts(const std::vector<Point>& from, const std::vector<Point>& to, CellShape side,
             const SideCoordinates& nodes);
  /// The side's nodes.
  SideShifts(const SurfaceSide& side, const ConstCoordinateView& from, const ConstCoordinateView& to);
  /// The rows of the points, from `first` on, of one column.
  void convect(const PointView& rows, int first, int column) const;

 private:
  using Along = Vec<double, 2>;  // [m] in the side's directions; in the plane the second is 0
  void measure(const std::vector<Point>& from, const std::vector<Point>& to, CellShape side,
               const SideCoordinates& nodes);
  /// Least squares.
  Along slope(const std::vector<double>& values) const;
  std::vector<Along> at_, shift_;
};

}  // namespace mudline
