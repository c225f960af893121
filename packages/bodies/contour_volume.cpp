#include "bodies/contour_volume.hpp"

#include <algorithm>
#include <cmath>

#include "framework/coordinates.hpp"

namespace mudline {

namespace {
constexpr int runs_per_piece = 32;
}  // namespace

ContourVolume::ContourVolume(const Contour& contour, Geometry geometry) : geometry_(geometry) {
  double left = 0, right = 0;
  for (const auto& piece : contour.pieces())
    for (int i = 0; i < runs_per_piece; ++i) {
      const double from = piece->length() * i / runs_per_piece, to = piece->length() * (i + 1) / runs_per_piece;
      const PlanePoint first = piece->point(from), last = piece->point(to);
      runs_.push_back({piece, from, to, first[1], last[1], integrate(*piece, from, to)});
      left = std::min({left, first[0], last[0]});
      right = std::max({right, first[0], last[0]});
    }
  const bool half = contour.extent() == ContourExtent::half;
  frontal_area_ = flank(right) - flank(left);
  const PlanePoint first = contour.pieces().front()->point(0);
  const PlanePoint last = contour.pieces().back()->point(contour.pieces().back()->length());
  const double open = half ? std::abs(last[0]) : std::hypot(last[0] - first[0], last[1] - first[1]);
  if (open > 1e-9 * contour.length()) return;
  for (const Run& run : runs_) total_ += run.volume;
}

double ContourVolume::flank(double x) const {
  const double middle[2] = {0.5 * x, 0};  // the measure is linear
  return x * measure(geometry_, middle);
}

double ContourVolume::integrate(const ContourPiece& piece, double from, double to) const {
  constexpr double at[4] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  constexpr double weight[4] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  double sum = 0;
  for (int q = 0; q < 4; ++q) {
    const double s = 0.5 * (from + to) + 0.5 * (to - from) * at[q];
    sum += 0.5 * (to - from) * weight[q] * flank(piece.point(s)[0]) * piece.tangent(s)[1];
  }
  return sum;
}

double ContourVolume::crossing(const Run& run, double h) {
  const bool up = run.low <= run.high;
  return place_at_height(*run.piece, up ? run.from : run.to, up ? run.to : run.from, h);
}

// By Green's theorem the volume below h is int flank(x) dy along the contour below h: neither the axis nor the level
// itself contributes.
double ContourVolume::below(double h) const {
  double sum = 0;
  for (const Run& run : runs_) {
    if (run.crosses(h)) {
      const double at = crossing(run, h);
      sum += run.low < h ? integrate(*run.piece, run.from, at) : integrate(*run.piece, at, run.to);
    } else if (run.low < h) {
      sum += run.volume;
    }
  }
  return sum;
}

double ContourVolume::section(double h) const {
  double sum = 0;
  for (const Run& run : runs_)
    if (run.crosses(h)) sum += (run.low < h ? 1 : -1) * flank(run.piece->point(crossing(run, h))[0]);
  return sum;
}

}  // namespace mudline
