#pragma once

#include <string>
#include <vector>

#include "ale/ale.hpp"
#include "contact/contact.hpp"

namespace mudline {

/// Takes rows of numbers that belong to places along a surface from one mesh to another of the same surface. A column
/// goes over by its unit: sums over a part of the surface (J, N, N m, m2, m3) keep their total on every path, flags (-)
/// are those of the nearest row, everything else is linear between the rows along the path, and constant beyond the
/// last ones. In space, where a mesh made anew keeps the faces of its boundary, every row is that of the old one at its
/// place.
class SurfaceCarrier {
 public:
  /// The mesh before, its nodes at x.
  SurfaceCarrier(const Ale& before, const Positions& x, const std::string& surface);
  /// Rows of this rank in and out. Collective.
  void carry(const ArrayInfo& info, const PointView& old, const std::vector<Point>& old_places, const PointView& now,
             const std::vector<Point>& new_places) const;

 private:
  struct Row {
    int path;
    double s;    // [m] along it
    int number;  // of all ranks' rows
  };
  /// All ranks' rows along the paths, in order.
  std::vector<std::vector<Row>> along(const std::vector<double>& places) const;
  Row locate(double x, double y, int number) const;
  void carry_in_space(const PointView& old, const std::vector<Point>& old_places, const PointView& now,
                      const std::vector<Point>& new_places) const;

  struct PathSide {
    int path, nodes[3];
    double from, to;  // [m]
  };
  const Comm& comm_;
  int dimension_;
  Positions x_;
  std::vector<PathSide> sides_;
  std::vector<double> lengths_;  // (path)
};

}  // namespace mudline
