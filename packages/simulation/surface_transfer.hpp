#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ale/ale.hpp"
#include "ale/face_locator.hpp"
#include "contact/contact.hpp"

namespace mudline {

/// Takes rows of numbers that belong to places along a surface from one mesh to another of the same surface. A column
/// goes over by its unit: sums over a part of the surface (J, N, N m, m2, m3) keep their total on every path, flags (-)
/// are those of the nearest row, everything else is linear between the rows along the path, and constant beyond the
/// last ones. In space rows on an old face are fitted by a linear function of its reference coordinates, within the
/// range of its rows; of sums the fit is that of the density, and all rows of the surface are then scaled to the old
/// total. A row at the place of an old one takes that one's numbers.
class SurfaceTransfer {
 public:
  /// The mesh before, its nodes at x.
  SurfaceTransfer(const Ale& before, const Positions& x, const std::string& surface);
  SurfaceTransfer(const SurfaceTransfer&) = delete;
  SurfaceTransfer& operator=(const SurfaceTransfer&) = delete;
  /// Rows of this rank in and out. Collective.
  void transfer(const ArrayInfo& info, const PointView& old, const SurfaceRows& old_rows, const PointView& now,
                const SurfaceRows& new_rows) const;

 private:
  struct Row {
    int path;
    double s;    // [m] along it
    int number;  // of all ranks' rows
  };
  /// All ranks' rows along the paths, in order.
  std::vector<std::vector<Row>> along(const std::vector<double>& places) const;
  Row locate(double x, double y, int number) const;
  /// Old rows of which a new one is made, on all ranks' list.
  struct Origin {
    int nearest;
    bool same;  // it is at the same place
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
