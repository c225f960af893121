#include "physics/rigid_body/contour_volume.hpp"

#include <algorithm>
#include <cmath>

namespace mudline {

namespace {
constexpr double pi = 3.14159265358979323846;
constexpr double chord_error = 1e-6;  // of the contour's length
}  // namespace

ContourVolume::ContourVolume(const Contour& contour, Geometry geometry)
    : points_(contour.sample(chord_error * contour.length())), axisymmetric_(geometry == Geometry::axisymmetric) {
  const bool half = contour.extent() == ContourExtent::half;
  double low = 0, high = 0;
  for (const PlanePoint& point : points_) {
    low = std::min(low, point[0]);
    high = std::max(high, point[0]);
  }
  frontal_area_ = axisymmetric_ ? pi * high * high : high - low;
  const PlanePoint first = points_.front(), last = points_.back();
  const double gap = half ? std::abs(last[0]) : std::hypot(last[0] - first[0], last[1] - first[1]);
  if (gap <= 1e-9 * contour.length()) total_ = below(1e300);
}

double ContourVolume::flank(double x) const { return axisymmetric_ ? pi * x * x : x; }

// int flank(x) dy along the contour as far as it is below h: by Green's theorem the volume that it encloses there, since
// neither the axis nor the level itself contributes.
double ContourVolume::below(double h) const {
  double sum = 0;
  for (std::size_t i = 1; i < points_.size(); ++i) {
    PlanePoint a = points_[i - 1], b = points_[i];
    if (a[1] >= h && b[1] >= h) continue;
    const bool cut = a[1] > h || b[1] > h;
    if (cut) {
      const double t = (h - a[1]) / (b[1] - a[1]);
      (a[1] > h ? a : b) = {a[0] + t * (b[0] - a[0]), h};
    }
    const double mean = axisymmetric_ ? pi * (a[0] * a[0] + a[0] * b[0] + b[0] * b[0]) / 3 : 0.5 * (a[0] + b[0]);
    sum += mean * (b[1] - a[1]);
  }
  return sum;
}

double ContourVolume::section(double h) const {
  double sum = 0;
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const PlanePoint &a = points_[i - 1], &b = points_[i];
    if ((a[1] < h) == (b[1] < h)) continue;
    const double x = a[0] + (h - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
    sum += b[1] > a[1] ? flank(x) : -flank(x);
  }
  return sum;
}

}  // namespace mudline
