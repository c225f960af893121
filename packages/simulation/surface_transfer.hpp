#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ale/ale.hpp"
#include "ale/face_locator.hpp"
#include "contact/contact.hpp"

namespace mudline {

/// Transfers rows of numbers that belong to places along a surface from one mesh to another. A column's unit decides
/// how it is transferred: sums over a part of the surface (J, N, N m, m2, m3) keep their total on every path, flags (-)
/// are those of the nearest row, everything else is linear between the rows along the path, and constant beyond the
/// last ones. In space the rows on an old face are fitted by a linear function of its reference coordinates, within the
/// range of its rows. Sums are fitted as densities, and all rows of the surface are then scaled to the old total. A row
/// at the place of an old one gets that row's numbers.
class SurfaceTransfer {
 public:
  /// `before`: the old mesh, with its nodes at `x` [m]. `surface`: name of a side set.
  SurfaceTransfer(const Ale& before, const Positions& x, const std::string& surface);
  SurfaceTransfer(const SurfaceTransfer&) = delete;
  SurfaceTransfer& operator=(const SurfaceTransfer&) = delete;
  /// Transfers an array; `old` and `now` hold this rank's rows. Collective.
  void transfer(const ArrayInfo& info, const PointView& old, const SurfaceRows& old_rows, const PointView& now,
                const SurfaceRows& new_rows) const;

 private:
  struct Row {
    int path;
    double s;    // [m] along it
    int number;  // in the list of all ranks' rows
  };
  /// Rows of all ranks by path, in order along it.
  std::vector<std::vector<Row>> along(const std::vector<double>& places) const;
  Row locate(double x, double y, int number) const;
  /// Old rows, by their number in the list of all ranks, from which a new one is interpolated.
  struct Origin {
    int nearest;
    bool same;  // the nearest one is at the same place
    std::vector<std::pair<int, double>> weights;
  };
  std::vector<Origin> origins(const std::vector<double>& from, const SurfaceRows& new_rows) const;
  void transfer_in_space(const ArrayInfo& info, const PointView& old, const SurfaceRows& old_rows, const PointView& now,
                         const SurfaceRows& new_rows) const;

  struct PathSide {
    int path, nodes[3];
    double from, to;  // [m]
  };
  const Comm& comm_;
  int dimension_;
  Positions x_;
  std::vector<PathSide> sides_;
  std::vector<double> lengths_;     // (path)
  std::vector<SurfaceFace> faces_;  // in space
  std::optional<FaceLocator> locator_;
};

}  // namespace mudline
