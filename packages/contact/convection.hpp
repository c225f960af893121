#pragma once

#include <vector>

#include "contact/contact_surface.hpp"

namespace mudline {

/// How far points of a side were moved along it under the material (ALE), and what becomes of a history that they
/// carry: f + (s_new - s_old) df/ds with the slope of f along the side.
class SideShifts {
 public:
  /// Points that were at `from` and are at `to` [m]; `along` the side.
  SideShifts(const std::vector<PlanePoint>& from, const std::vector<PlanePoint>& to, const PlanePoint& chord);
  /// The side's nodes.
  SideShifts(const SurfaceSide& side, const ConstCoordinateView& from, const ConstCoordinateView& to);
  /// The rows of the points, from `first` on, of one column.
  void convect(const PointView& rows, int first, int column) const;

 private:
  void measure(const std::vector<PlanePoint>& from, const std::vector<PlanePoint>& to, const PlanePoint& chord);
  std::vector<double> at_, shift_;  // [m] along the side
};

}  // namespace mudline
