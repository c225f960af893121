#include "contact/convection.hpp"

#include <cmath>

namespace mudline {

namespace {

/// Least squares slope of values over places.
double slope(const std::vector<double>& at, const std::vector<double>& values) {
  double mean_at = 0, mean = 0, top = 0, bottom = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    mean_at += at[i] / at.size();
    mean += values[i] / at.size();
  }
  for (std::size_t i = 0; i < at.size(); ++i) {
    top += (at[i] - mean_at) * (values[i] - mean);
    bottom += (at[i] - mean_at) * (at[i] - mean_at);
  }
  return bottom > 0 ? top / bottom : 0.0;
}

PlanePoint place(int node, const ConstCoordinateView& x) { return {x(node, 0), x(node, 1)}; }

}  // namespace

SideShifts::SideShifts(const std::vector<PlanePoint>& from, const std::vector<PlanePoint>& to,
                       const PlanePoint& chord) {
  measure(from, to, chord);
}

SideShifts::SideShifts(const SurfaceSide& side, const ConstCoordinateView& from, const ConstCoordinateView& to) {
  std::vector<PlanePoint> before, after;
  for (int a = 0; a < side.count; ++a) {
    before.push_back(place(side.node[a], from));
    after.push_back(place(side.node[a], to));
  }
  measure(before, after, {before[1][0] - before[0][0], before[1][1] - before[0][1]});
}

void SideShifts::measure(const std::vector<PlanePoint>& from, const std::vector<PlanePoint>& to,
                         const PlanePoint& chord) {
  const double length = std::hypot(chord[0], chord[1]);
  const PlanePoint along{chord[0] / length, chord[1] / length};
  for (std::size_t c = 0; c < from.size(); ++c) {
    at_.push_back(from[c][0] * along[0] + from[c][1] * along[1]);
    shift_.push_back((to[c][0] - from[c][0]) * along[0] + (to[c][1] - from[c][1]) * along[1]);
  }
}

void SideShifts::convect(const PointView& rows, int first, int column) const {
  std::vector<double> values;
  for (std::size_t c = 0; c < at_.size(); ++c) values.push_back(rows(first + c, column));
  const double gradient = slope(at_, values);
  for (std::size_t c = 0; c < at_.size(); ++c) rows(first + c, column) = values[c] + gradient * shift_[c];
}

}  // namespace mudline
