#include "contact/convection.hpp"

#include <cmath>

#include "tensor/vec.hpp"

namespace mudline {

namespace {

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

}  // namespace

SideShifts::SideShifts(const std::vector<Point>& from, const std::vector<Point>& to, CellShape side,
                       const SideCoordinates& nodes) {
  measure(from, to, side, nodes);
}

SideShifts::SideShifts(const SurfaceSide& side, const ConstCoordinateView& from, const ConstCoordinateView& to) {
  const SideCoordinates before = side_coordinates(side, from), after = side_coordinates(side, to);
  measure({before.begin(), before.begin() + side.count}, {after.begin(), after.begin() + side.count}, side.shape,
          before);
}

void SideShifts::measure(const std::vector<Point>& from, const std::vector<Point>& to, CellShape side,
                         const SideCoordinates& nodes) {
  const std::array<Point, 2> along = directions(side, nodes);
  for (std::size_t c = 0; c < from.size(); ++c) {
    const Point displacement = to[c] - from[c];
    at_.push_back({dot(from[c], along[0]), dot(from[c], along[1])});
    shift_.push_back({dot(displacement, along[0]), dot(displacement, along[1])});
  }
}

SideShifts::Along SideShifts::slope(const std::vector<double>& values) const {
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

void SideShifts::convect(const PointView& rows, int first, int column) const {
  std::vector<double> values;
  for (std::size_t c = 0; c < at_.size(); ++c) values.push_back(rows(first + c, column));
  const Along gradient = slope(values);
  for (std::size_t c = 0; c < at_.size(); ++c)
    rows(first + c, column) = values[c] + gradient[0] * shift_[c][0] + gradient[1] * shift_[c][1];
}

void convect_rows(const std::vector<SurfaceSide>& sides, const std::map<CellShape, ContactRule>& rules,
                  const ConstCoordinateView& x_old, const State& committed,
                  const std::vector<std::pair<int, int>>& columns) {
  if (columns.empty()) return;
  int first = 0;
  for (const SurfaceSide& side : sides) {
    const ContactRule& rule = rules.at(side.shape);
    const SideCoordinates before = side_coordinates(side, x_old), after = side_coordinates(side, committed.coordinates);
    std::vector<Point> from, to;
    for (int c = 0; c < rule.points; ++c) {
      from.push_back(rule.place(c, before));
      to.push_back(rule.place(c, after));
    }
    const SideShifts shifts(from, to, side.shape, before);
    for (const auto& [array, column] : columns) shifts.convect(committed.arrays[array], first, column);
    first += rule.points;
  }
}

}  // namespace mudline
