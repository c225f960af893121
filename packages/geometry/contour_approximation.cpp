#include "geometry/contour_approximation.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/told.hpp"
#include "geometry/curve_piece.hpp"

namespace mudline {

namespace {

bool straight(const ContourPiece& piece) { return dynamic_cast<const LinePiece*>(&piece) != nullptr; }

/// Points along neighbouring curved pieces, with the pieces' ends.
std::vector<PlanePoint> points_along(const ContourPieces& pieces, double chord) {
  std::vector<PlanePoint> points{pieces.front()->point(0)};
  for (const auto& piece : pieces) {
    const int chords = std::max(1, static_cast<int>(std::ceil(piece->length() / chord * (1 - 1e-9))));
    for (int i = 1; i <= chords; ++i) points.push_back(piece->point(piece->length() * i / chords));
  }
  return points;
}

/// Direction at an end of a closed run or at one on the axis, from the neighbour beyond that end; 0 at other ends.
PlanePoint end_direction(const std::vector<PlanePoint>& points, bool at_start, bool closed, bool on_axis) {
  const std::size_t n = points.size();
  if (closed) return {points[1][0] - points[n - 2][0], points[1][1] - points[n - 2][1]};
  if (!on_axis) return {0, 0};
  // the neighbour beyond the axis is the mirror image
  return {at_start ? 1.0 : -1.0, 0.0};
}

}  // namespace

Contour approximated(const Contour& contour, Approximation kind, double chord) {
  const auto& all = contour.pieces();
  const bool half = contour.extent() == ContourExtent::half;
  const double tolerance = 1e-9 * contour.length();
  ContourPieces result;
  for (std::size_t i = 0; i < all.size();) {
    if (straight(*all[i])) {
      result.push_back(all[i++]);
      continue;
    }
    const std::size_t begin = i;
    ContourPieces run;
    // a run ends at a straight piece and at a corner
    do {
      run.push_back(all[i++]);
      if (i == all.size() || straight(*all[i])) break;
      const PlanePoint before = all[i - 1]->tangent(all[i - 1]->length()), after = all[i]->tangent(0);
      if (before[0] * after[0] + before[1] * after[1] < 1 - 1e-6) break;
    } while (true);
    const std::vector<PlanePoint> points = points_along(run, chord);
    if (kind == Approximation::facets) {
      for (std::size_t k = 1; k < points.size(); ++k)
        result.push_back(std::make_shared<LinePiece>(points[k - 1], points[k]));
      continue;
    }
    const PlanePoint first = points.front(), last = points.back();
    const bool closed =
        begin == 0 && i == all.size() && !half && std::hypot(last[0] - first[0], last[1] - first[1]) <= tolerance;
    PlanePoint start = end_direction(points, true, closed, half && std::abs(first[0]) <= tolerance);
    PlanePoint end = end_direction(points, false, closed, half && std::abs(last[0]) <= tolerance);
    // beside a straight piece the end keeps the contour's own direction
    if (begin > 0 && straight(*all[begin - 1])) start = run.front()->tangent(0);
    if (i < all.size() && straight(*all[i])) end = run.back()->tangent(run.back()->length());
    for (auto& piece : hermite_pieces(points, start, end)) result.push_back(std::move(piece));
  }
  return Contour(std::move(result), contour.extent());
}

std::string contour_fault(const Contour& contour) {
  const std::vector<PlanePoint> p = contour.sample(1e-3 * contour.length());
  const std::size_t n = p.size();
  const bool half = contour.extent() == ContourExtent::half;
  // twice the area on the left of the path; a half contour is closed along its axis, an open one beyond all of it,
  // above or, where its last line runs down for ever, below
  double area = 0;
  for (std::size_t i = 0; i + 1 < n; ++i) area += p[i][0] * p[i + 1][1] - p[i + 1][0] * p[i][1];
  if (half && p[n - 1][0] > 1e-9 * contour.length()) {
    const bool down = p[n - 1][1] < p[n - 2][1] - 0.7 * std::abs(p[n - 1][0] - p[n - 2][0]);
    double end = p[0][1];
    for (const PlanePoint& point : p) end = down ? std::min(end, point[1]) : std::max(end, point[1]);
    end += down ? -p[n - 1][0] : p[n - 1][0];
    area += p[n - 1][0] * (end - p[n - 1][1]) + p[n - 1][0] * end;
  } else if (!half) {
    area += p[n - 1][0] * p[0][1] - p[0][0] * p[n - 1][1];
  }
  if (area < -1e-12 * contour.length() * contour.length())
    return "the contour is inverted: the body must lie on the left of the path from the first point to the last (from "
           "the tip "
           "up the right-hand side)";
  const auto side = [](const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  };
  for (std::size_t i = 0; i + 1 < n; ++i)
    for (std::size_t j = i + 2; j + 1 < n; ++j) {
      if (side(p[i], p[i + 1], p[j]) * side(p[i], p[i + 1], p[j + 1]) >= 0 ||
          side(p[j], p[j + 1], p[i]) * side(p[j], p[j + 1], p[i + 1]) >= 0)
        continue;
      const PlanePoint middle = 0.5 * (p[i] + p[i + 1]);
      return "the contour crosses itself near (" + told(middle[0], "%.4g, ") + told(middle[1], "%.4g)");
    }
  return "";
}

}  // namespace mudline
