#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/side_rule.hpp"
#include "framework/state.hpp"

namespace mudline {

/// Points on the sides of a side set, one side after the other: the rows of an array of the state.
class SurfacePoints {
 public:
  using At = SideRule::At;
  static constexpr long long most_points_of_side = 64;
  /// `at`, `degree`: of the rule of each side.
  SurfacePoints(const Mesh& mesh, const std::string& side_set, At at, int degree);

  const std::string& side_set() const { return set_; }
  int count() const { return static_cast<int>(ids_.size()); }
  /// Ids by row, independent of the number of ranks: that of the side times `most_points_of_side`, and the point.
  const std::vector<long long>& ids() const { return ids_; }
  /// Places [m] by row, for nodes at x.
  std::vector<Point> places(const ConstCoordinateView& x) const;
  /// Areas [m2] by row, of the part of the surface that the row stands for; in plane strain per metre of depth.
  std::vector<double> areas(const ConstCoordinateView& x) const;
  /// Transfers the rows of an array in place when the nodes have moved from x_old to x. Values: f + (s_new - s_old) .
  /// grad f, with the gradient along the side by least squares over its rows. Nearest: of the side's old rows. A row
  /// keeps its part of a total.
  void follow(const std::vector<StateVariable>& variables, const ConstCoordinateView& x_old,
              const ConstCoordinateView& x, const PointView& rows) const;
  /// Means at the nodes of the nearest rows of the sides around them, of a column. Adds the values to `sums` and counts
  /// them in `counts`, both by local node, for this rank's sides.
  void add_at_nodes(const PointView& rows, int column, std::vector<double>& sums, std::vector<double>& counts) const;

 private:
  struct Side {
    CellShape shape;
    std::vector<int> nodes;  // local
    int first;               // row
  };
  static SideCoordinates coordinates_of(const Side& side, const ConstCoordinateView& x);
  static std::vector<Point> places(const Side& side, const SideRule& rule, const ConstCoordinateView& x);

  const Mesh& mesh_;
  std::string set_;
  std::map<CellShape, SideRule> rules_;
  std::vector<Side> sides_;
  std::vector<long long> ids_;
};

}  // namespace mudline
