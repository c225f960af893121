#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ale/ale.hpp"
#include "ale/face_locator.hpp"

namespace mudline {

/// Transfers arrays whose rows are points of a surface from one mesh to another, by the rule of each variable. In the
/// plane totals are kept on every path, and values are linear between the rows along the path, and constant beyond the
/// last ones. In space the rows on an old face are fitted by a linear function of its reference coordinates, within the
/// range of its rows. Totals are fitted as densities, and all rows of the surface are then scaled to the old total. A
/// row at the place of an old one gets that row's numbers.
class SurfaceTransfer {
 public:
  /// `before`: the old mesh, with its nodes at `x` [m]. `surface`: name of a side set.
  SurfaceTransfer(const Ale& before, const Positions& x, const std::string& surface);
  SurfaceTransfer(const SurfaceTransfer&) = delete;
  SurfaceTransfer& operator=(const SurfaceTransfer&) = delete;
  /// An array on one of the meshes: this rank's rows, their places [m] and areas [m2].
  struct Rows {
    PointView values;
    std::vector<Point> places;
    std::vector<double> areas;
    std::vector<Point> inside;  // places a little towards the middle of their sides
    Rows(const ArrayInfo& info, const PointView& rows, const ConstCoordinateView& x);
  };
  /// Transfers an array. Collective.
  void transfer(const std::vector<StateVariable>& variables, const Rows& old, const Rows& now) const;

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
  std::vector<Origin> origins(const Rows& old, const Rows& now) const;
  /// The face of the old mesh on which a row stands. Rows on its edges belong to the side that they were declared on.
  SurfacePlace face_of(const Point& place, const Point& inside) const;
  void transfer_in_space(const std::vector<StateVariable>& variables, const Rows& old, const Rows& now) const;

  struct PathSide {
    int path, nodes[3];
    double from, to;  // [m]
  };
  /// A column of the rows of all ranks.
  std::vector<double> column_of(const PointView& rows, int column) const;

  const GhostedMesh& mesh_;
  const Comm& comm_;
  int dimension_;
  Positions x_;
  std::vector<PathSide> sides_;
  std::vector<double> lengths_;     // (path)
  std::vector<SurfaceFace> faces_;  // in space
  std::optional<FaceLocator> locator_;
};

}  // namespace mudline
