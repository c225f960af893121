#include "ale/path_curve.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mudline {

PathCurve::PathCurve(Positions points) : points_(std::move(points)) {
  const int n = static_cast<int>(points_.size());
  if (n < 2) throw std::logic_error("a curve needs two points");
  s_.push_back(0);
  for (int i = 1; i < n; ++i) s_.push_back(s_.back() + distance(points_[i], points_[i - 1]));
  for (int i = 0; i < n; ++i) {
    Point slope{};
    for (int d = 0; d < place_size; ++d) {
      const auto secant = [&](int k) { return (points_[k + 1][d] - points_[k][d]) / (s_[k + 1] - s_[k]); };
      if (n == 2) {
        slope[d] = secant(0);
        continue;
      }
      const int k = std::clamp(i, 1, n - 2);  // middle of the parabola
      const double before = s_[k] - s_[k - 1], after = s_[k + 1] - s_[k];
      const double bend = (secant(k) - secant(k - 1)) / (before + after);
      slope[d] = secant(k - 1) + bend * before + 2 * bend * (s_[i] - s_[k]);
    }
    slopes_.push_back(slope);
  }
}

int PathCurve::segment(double s) const {
  const int last = static_cast<int>(s_.size()) - 2;
  return std::clamp(static_cast<int>(std::upper_bound(s_.begin(), s_.end(), s) - s_.begin()) - 1, 0, last);
}

Point PathCurve::at(double s) const {
  const int k = segment(s);
  const double h = s_[k + 1] - s_[k], t = (s - s_[k]) / h;
  const double start = (1 + 2 * t) * (1 - t) * (1 - t), end = t * t * (3 - 2 * t);
  Point x;
  for (int d = 0; d < place_size; ++d)
    x[d] = start * points_[k][d] + end * points_[k + 1][d] +
           h * t * (1 - t) * ((1 - t) * slopes_[k][d] - t * slopes_[k + 1][d]);
  return x;
}

double PathCurve::interpolate(const std::vector<double>& values, double s) const {
  const int k = segment(s);
  const double t = (s - s_[k]) / (s_[k + 1] - s_[k]);
  return (1 - t) * values[k] + t * values[k + 1];
}

CurveMeasure::CurveMeasure(const PathCurve& curve, const SizeField& size)
    : CurveMeasure(
          curve.length(), [&](double s) { return size(curve.at(s)); }, 8 * curve.points()) {}

CurveMeasure::CurveMeasure(double length, const std::function<double(double s)>& size, int samples) {
  step_ = length / samples;
  sum_.push_back(0);
  double before = 1 / size(0);
  for (int i = 1; i <= samples; ++i) {
    const double here = 1 / size(step_ * i);
    sum_.push_back(sum_.back() + 0.5 * step_ * (before + here));
    before = here;
  }
}

double CurveMeasure::at(double s) const {
  const int last = static_cast<int>(sum_.size()) - 2;
  const int k = std::clamp(static_cast<int>(s / step_), 0, last);
  return sum_[k] + (sum_[k + 1] - sum_[k]) * (s / step_ - k);
}

double CurveMeasure::place(double measure) const {
  const int last = static_cast<int>(sum_.size()) - 2;
  const int k =
      std::clamp(static_cast<int>(std::upper_bound(sum_.begin(), sum_.end(), measure) - sum_.begin()) - 1, 0, last);
  return step_ * (k + (measure - sum_[k]) / (sum_[k + 1] - sum_[k]));
}

std::vector<double> divided(double length, const std::function<double(double s)>& size, int parts) {
  double smallest = 1e300;
  for (int i = 0; i <= 8 * parts; ++i) smallest = std::min(smallest, size(length * i / (8 * parts)));
  constexpr double per_side = 8, most = 1e5;  // samples
  const CurveMeasure measure(length, size,
                             static_cast<int>(std::clamp(per_side * length / smallest, 8.0 * (parts + 1), most)));
  const int sides = std::max(1, static_cast<int>(std::lround(measure.total())));
  std::vector<double> s{0};
  for (int k = 1; k < sides; ++k) s.push_back(measure.place(k * measure.total() / sides));
  s.push_back(length);
  return s;
}

}  // namespace mudline
