#include "framework/surface_points.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mudline {

namespace {

constexpr long long most_sides_of_element = 6;

/// Directions along a side: that of its first edge, and in space the one perpendicular to it; in the plane the second
/// is 0.
std::array<Point, 2> directions(CellShape side, const SideCoordinates& nodes) {
  const Point chord = nodes[1] - nodes[0];
  const double length_of_chord = std::hypot(std::hypot(chord[0], chord[1]), chord[2]);
  std::array<Point, 2> along{};
  for (int i = 0; i < 3; ++i) along[0][i] = chord[i] / length_of_chord;
  if (dimension(side) == 1) return along;
  const Point other = nodes[num_corners(side) - 1] - nodes[0];
  const Point across = other - dot(other, along[0]) * along[0];
  along[1] = 1 / length(across) * across;
  return along;
}

/// Points of one side that have moved along it: history stays where it is while they move.
class SideShifts {
 public:
  /// The points were at `from` and are at `to` [m].
  SideShifts(const std::vector<Point>& from, const std::vector<Point>& to, const std::array<Point, 2>& along)
      : from_(from), to_(to) {
    for (std::size_t c = 0; c < from.size(); ++c) {
      const Point displacement = to[c] - from[c];
      at_.push_back({dot(from[c], along[0]), dot(from[c], along[1])});
      shift_.push_back({dot(displacement, along[0]), dot(displacement, along[1])});
    }
  }
  /// Values of a field at the points' new places from those at the old ones.
  std::vector<double> of_field(const std::vector<double>& values) const {
    const Along gradient = slope(values);
    std::vector<double> result;
    for (std::size_t c = 0; c < at_.size(); ++c)
      result.push_back(values[c] + gradient[0] * shift_[c][0] + gradient[1] * shift_[c][1]);
    return result;
  }
  /// At each new place the value of the nearest old one.
  std::vector<double> of_nearest(const std::vector<double>& values) const {
    std::vector<double> result;
    for (const Point& place : to_) {
      std::size_t nearest = 0;
      for (std::size_t c = 1; c < from_.size(); ++c)
        if (length(from_[c] - place) < length(from_[nearest] - place)) nearest = c;
      result.push_back(values[nearest]);
    }
    return result;
  }

 private:
  using Along = Vec<double, 2>;  // [m] in the side's directions; in the plane the second is 0
  /// Gradient of values along the side by least squares.
  Along slope(const std::vector<double>& values) const {
    Along mean_at{};
    double mean = 0;
    for (std::size_t c = 0; c < at_.size(); ++c) {
      for (int k = 0; k < 2; ++k) mean_at[k] += at_[c][k] / at_.size();
      mean += values[c] / at_.size();
    }
    double top[2] = {}, bottom[3] = {};  // xx, yy, xy
    for (std::size_t c = 0; c < at_.size(); ++c) {
      const double x = at_[c][0] - mean_at[0], y = at_[c][1] - mean_at[1];
      top[0] += x * (values[c] - mean);
      top[1] += y * (values[c] - mean);
      bottom[0] += x * x;
      bottom[1] += y * y;
      bottom[2] += x * y;
    }
    Along result{};
    if (!(bottom[0] > 0)) return result;
    // points on one line determine the slope along it only
    const double rest = bottom[1] - bottom[2] / bottom[0] * bottom[2];
    if (rest > 1e-9 * bottom[0]) result[1] = (top[1] - bottom[2] / bottom[0] * top[0]) / rest;
    result[0] = result[1] == 0 ? top[0] / bottom[0] : (top[0] - bottom[2] * result[1]) / bottom[0];
    return result;
  }

  const std::vector<Point>&from_, &to_;
  std::vector<Along> at_, shift_;
};

}  // namespace

SideCoordinates SurfacePoints::coordinates_of(const Side& side, const ConstCoordinateView& x) {
  return side_coordinates(side.nodes.data(), static_cast<int>(side.nodes.size()), x);
}

SurfacePoints::SurfacePoints(const Mesh& mesh, const std::string& side_set, At at, int degree)
    : mesh_(mesh), set_(side_set) {
  if (!mesh.has_side_set(side_set)) throw std::logic_error("there is no side set '" + side_set + "'");
  for (const mudline::Side& side : mesh.side_sets().at(side_set)) {
    const ElementBlock& block = mesh.blocks()[side.block];
    Side here{side_shape(block.shape, side.side), {}, count()};
    for (int local : side_nodes(block.shape, side.side)) here.nodes.push_back(block.nodes(side.element, local));
    if (rules_.count(here.shape) == 0) rules_.emplace(here.shape, SideRule(here.shape, at, degree));
    const long long id = block.global_ids[side.element] * most_sides_of_element + side.side;
    for (int c = 0; c < rules_.at(here.shape).points; ++c) ids_.push_back(id * most_points_of_side + c);
    sides_.push_back(std::move(here));
  }
}

std::vector<Point> SurfacePoints::places(const Side& side, const SideRule& rule, const ConstCoordinateView& x) {
  const SideCoordinates nodes = coordinates_of(side, x);
  std::vector<Point> result;
  for (int c = 0; c < rule.points; ++c) result.push_back(rule.place(c, nodes));
  return result;
}

std::vector<Point> SurfacePoints::places(const ConstCoordinateView& x) const {
  std::vector<Point> result;
  for (const Side& side : sides_) {
    const std::vector<Point> here = places(side, rules_.at(side.shape), x);
    result.insert(result.end(), here.begin(), here.end());
  }
  return result;
}

std::vector<double> SurfacePoints::areas(const ConstCoordinateView& x) const {
  std::vector<double> result;
  for (const Side& side : sides_) {
    const SideRule& rule = rules_.at(side.shape);
    std::vector<double> here(rule.points);
    point_areas(rule, coordinates_of(side, x), mesh_.geometry(), here.data());
    result.insert(result.end(), here.begin(), here.end());
  }
  return result;
}

void SurfacePoints::follow(const std::vector<StateVariable>& variables, const ConstCoordinateView& x_old,
                           const ConstCoordinateView& x, const PointView& rows) const {
  for (const Side& side : sides_) {
    const SideRule& rule = rules_.at(side.shape);
    const std::vector<Point> from = places(side, rule, x_old), to = places(side, rule, x);
    const SideShifts shifts(from, to, directions(side.shape, coordinates_of(side, x_old)));
    int column = 0;
    for (const StateVariable& variable : variables)
      for (int k = 0; k < variable.components; ++k, ++column) {
        if (variable.transfer == Transfer::total) continue;
        std::vector<double> values;
        for (std::size_t c = 0; c < from.size(); ++c) values.push_back(rows(side.first + c, column));
        values = variable.transfer == Transfer::nearest ? shifts.of_nearest(values) : shifts.of_field(values);
        for (std::size_t c = 0; c < from.size(); ++c)
          rows(side.first + c, column) = std::clamp(values[c], variable.low, variable.high);
      }
  }
}

void SurfacePoints::add_at_nodes(const PointView& rows, int column, std::vector<double>& sums,
                                 std::vector<double>& counts) const {
  for (const Side& side : sides_) {
    const SideRule& rule = rules_.at(side.shape);
    for (std::size_t a = 0; a < side.nodes.size(); ++a) {
      // the row whose place has the largest part of this node's, and all that are as near
      double most = 0, sum = 0;
      for (int c = 0; c < rule.points; ++c) most = std::max(most, rule.shape(c, a));
      int near = 0;
      for (int c = 0; c < rule.points; ++c)
        if (rule.shape(c, a) >= most - 1e-9) {
          sum += rows(side.first + c, column);
          ++near;
        }
      sums[side.nodes[a]] += sum / near;
      counts[side.nodes[a]] += 1;
    }
  }
}

}  // namespace mudline
