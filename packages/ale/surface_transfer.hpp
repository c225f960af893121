#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ale/ale.hpp"
#include "ale/face_locator.hpp"
#include "framework/surface_points.hpp"

namespace mudline {

/// Transfers arrays whose rows are the same points of a surface from one mesh to another, by the rule of each variable.
/// In the plane totals are kept on every path, and values are linear between the rows along the path, and constant
/// beyond the last ones. In space the rows on an old face are fitted by a linear function of its reference coordinates,
/// within the range of its rows. Totals are fitted as densities, and all rows of the surface are then scaled to the old
/// total. A row at the place of an old one gets that row's numbers.
class SurfaceTransfer {
 public:
  /// Points on one of the meshes, with its nodes at x.
  struct Side {
    const SurfacePoints& points;
    ConstCoordinateView x;
  };
  /// `before`: the old mesh. Collective.
  SurfaceTransfer(const Ale& before, const Side& old, const Side& now);
  SurfaceTransfer(const SurfaceTransfer&) = delete;
  SurfaceTransfer& operator=(const SurfaceTransfer&) = delete;
  /// Transfers this rank's rows of an array. Collective.
  void transfer(const std::vector<StateVariable>& variables, const PointView& old, const PointView& now) const;

 private:
  /// This rank's rows.
  struct Rows {
    std::vector<Point> places;  // [m]
    std::vector<double> areas;  // [m2]
    std::vector<Point> inside;  // places a little towards the middle of their sides
    explicit Rows(const Side& side);
  };
  struct Row {
    int path;
    double s;    // [m] along it
    int number;  // in the list of all ranks' rows
  };
  /// Rows of all ranks by path, in order along it.
  std::vector<std::vector<Row>> along(const std::vector<double>& places) const;
  Row locate(const Point& place, int number) const;
  /// Old rows, by their number in the list of all ranks, from which a new one is interpolated.
  struct Origin {
    int nearest;
    bool same;  // the nearest one is at the same place
    std::vector<std::pair<int, double>> weights;
  };
  std::vector<Origin> origins(const Rows& old, const Rows& now) const;
  /// The face of the old mesh on which a row stands. Rows on its edges belong to the side that they were declared on.
  SurfacePlace face_of(const Point& place, const Point& inside) const;
  void transfer_in_space(const std::vector<StateVariable>& variables, const PointView& old, const PointView& now) const;

  struct PathSide {
    int path;
    double from, to;  // [m] along it
  };
  /// A column of the rows of all ranks.
  std::vector<double> column_of(const PointView& rows, int column) const;

  const GhostedMesh& mesh_;
  const Comm& comm_;
  int dimension_;
  Positions x_;
  // in the plane
  std::vector<PathSide> sides_;
  std::optional<SideLocator> side_locator_;
  std::vector<double> lengths_;              // (path)
  std::vector<std::vector<Row>> from_, to_;  // (path)
  int mine_ = 0, end_ = 0;                   // numbers of this rank's new rows
  // in space
  std::vector<SurfaceFace> faces_;
  std::optional<FaceLocator> face_locator_;
  std::vector<double> old_areas_, areas_;  // of all ranks' old rows, of this rank's new ones [m2]
  std::vector<Origin> origins_;            // of this rank's new rows
};

}  // namespace mudline
