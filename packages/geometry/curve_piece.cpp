#include "geometry/curve_piece.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "geometry/closest_on_curve.hpp"

namespace mudline {

namespace {

constexpr int runs = 24;
constexpr int gauss_points = 6;
constexpr double gauss_at[gauss_points] = {-0.9324695142031521, -0.6612093864662645, -0.2386191860831969,
                                           0.2386191860831969,  0.6612093864662645,  0.9324695142031521};
constexpr double gauss_weight[gauss_points] = {0.1713244923791704, 0.3607615730481386, 0.4679139345726910,
                                               0.4679139345726910, 0.3607615730481386, 0.1713244923791704};

/// The mirror image about x = 0, backwards.
class MirroredCurve : public ParametricCurve {
 public:
  explicit MirroredCurve(std::shared_ptr<const ParametricCurve> curve) : curve_(std::move(curve)) {}
  CurvePoint<2> at(double t) const override {
    const CurvePoint<2> p = curve_->at(1 - t);
    return {{-p.x[0], p.x[1]}, {p.d[0], -p.d[1]}, {-p.dd[0], p.dd[1]}};
  }

 private:
  std::shared_ptr<const ParametricCurve> curve_;
};

}  // namespace

CurvePiece::CurvePiece(std::shared_ptr<const ParametricCurve> curve) : curve_(std::move(curve)), start_{0.0} {
  for (int i = 0; i <= runs; ++i) {
    const double t = static_cast<double>(i) / runs;
    sample_.push_back(curve_->at(t).x);
    if (i < runs) start_.push_back(start_.back() + arc(t, static_cast<double>(i + 1) / runs));
  }
  for (int i = 0; i <= 4 * runs; ++i)
    if (!(dot(curve_->at(i / (4.0 * runs)).d, curve_->at(i / (4.0 * runs)).d) > 1e-16 * length() * length()))
      throw std::logic_error("a contour curve stands still at one of its points");
}

double CurvePiece::arc(double from, double to) const {
  double sum = 0;
  for (int q = 0; q < gauss_points; ++q) {
    const PlanePoint d = curve_->at(0.5 * (from + to) + 0.5 * (to - from) * gauss_at[q]).d;
    sum += 0.5 * (to - from) * gauss_weight[q] * std::hypot(d[0], d[1]);
  }
  return sum;
}

double CurvePiece::parameter(double s) const {
  if (s <= 0) return 0;
  if (s >= length()) return 1;
  const int run =
      std::min(runs - 1, static_cast<int>(std::upper_bound(start_.begin(), start_.end(), s) - start_.begin()) - 1);
  const double from = static_cast<double>(run) / runs;
  double t = from + (s - start_[run]) / (start_[run + 1] - start_[run]) / runs;
  for (int i = 0; i < 20; ++i) {
    const PlanePoint d = curve_->at(t).d;
    const double step = (s - start_[run] - arc(from, t)) / std::hypot(d[0], d[1]);
    t += step;
    if (std::abs(step) < 1e-15) break;
  }
  return std::min(1.0, std::max(0.0, t));
}

PlanePoint CurvePiece::tangent(double s) const {
  const PlanePoint d = curve_->at(parameter(s)).d;
  const double size = std::hypot(d[0], d[1]);
  return {d[0] / size, d[1] / size};
}

double CurvePiece::curvature(double s) const {
  const CurvePoint<2> p = curve_->at(parameter(s));
  return (p.d[0] * p.dd[1] - p.d[1] * p.dd[0]) / std::pow(dot(p.d, p.d), 1.5);
}

double CurvePiece::closest(const PlanePoint& x) const {
  const CurveBracket bracket =
      around_closest_sample(0, 1, runs, [&](int i, double) { return dot(x - sample_[i], x - sample_[i]); });
  const double t = closest_on_curve([&](double at) { return curve_->at(at); }, x, bracket);
  if (t == 0) return 0;
  if (t == 1) return length();
  const int run = std::min(runs - 1, static_cast<int>(t * runs));
  return start_[run] + arc(static_cast<double>(run) / runs, t);
}

std::shared_ptr<const ContourPiece> CurvePiece::mirrored() const {
  return std::make_shared<CurvePiece>(std::make_shared<MirroredCurve>(curve_));
}

CurvePoint<2> CubicBezier::at(double t) const {
  const double u = 1 - t;
  CurvePoint<2> p;
  for (int i = 0; i < 2; ++i) {
    p.x[i] = u * u * u * b_[0][i] + 3 * u * u * t * b_[1][i] + 3 * u * t * t * b_[2][i] + t * t * t * b_[3][i];
    p.d[i] = 3 * (u * u * (b_[1][i] - b_[0][i]) + 2 * u * t * (b_[2][i] - b_[1][i]) + t * t * (b_[3][i] - b_[2][i]));
    p.dd[i] = 6 * (u * (b_[2][i] - 2 * b_[1][i] + b_[0][i]) + t * (b_[3][i] - 2 * b_[2][i] + b_[1][i]));
  }
  return p;
}

NurbsSpan::NurbsSpan(int degree, std::vector<double> knots, std::vector<PlanePoint> points, std::vector<double> weights,
                     int span)
    : degree_(degree),
      span_(span),
      knots_(std::move(knots)),
      points_(std::move(points)),
      weights_(std::move(weights)) {}

// De Boor's algorithm on homogeneous coordinates (w x, w y, w); the derivatives are splines of their control points'
// divided differences.
CurvePoint<2> NurbsSpan::at(double t) const {
  using Homogeneous = Vec<double, 3>;
  const double width = knots_[span_ + 1] - knots_[span_], u = knots_[span_] + t * width;
  std::vector<Homogeneous> control;
  for (int i = span_ - degree_; i <= span_; ++i)
    control.push_back({weights_[i] * points_[i][0], weights_[i] * points_[i][1], weights_[i]});
  Homogeneous level[3] = {};
  for (int order = 0; order <= std::min(2, degree_); ++order) {
    const int p = degree_ - order;
    if (order > 0) {  // control points of the derivative
      std::vector<Homogeneous> next;
      for (std::size_t j = 0; j + 1 < control.size(); ++j) {
        const int i = span_ - degree_ + order + static_cast<int>(j);
        Homogeneous d{};
        for (int c = 0; c < 3; ++c)
          d[c] = (p + 1) * (control[j + 1][c] - control[j][c]) / (knots_[i + p + 1] - knots_[i]);
        next.push_back(d);
      }
      control = std::move(next);
    }
    std::vector<Homogeneous> d = control;
    for (int r = 1; r <= p; ++r)
      for (int j = p; j >= r; --j) {
        const int i = span_ - p + j;
        const double a = (u - knots_[i]) / (knots_[i + p - r + 1] - knots_[i]);
        for (int c = 0; c < 3; ++c) d[j][c] = (1 - a) * d[j - 1][c] + a * d[j][c];
      }
    level[order] = d[p];
  }
  CurvePoint<2> result;
  const double w = level[0][2], dw = level[1][2], ddw = level[2][2];
  for (int i = 0; i < 2; ++i) {
    result.x[i] = level[0][i] / w;
    const double d = (level[1][i] - dw * result.x[i]) / w;
    const double dd = (level[2][i] - 2 * dw * d - ddw * result.x[i]) / w;
    result.d[i] = d * width;
    result.dd[i] = dd * width * width;
  }
  return result;
}

ContourPieces hermite_pieces(const std::vector<PlanePoint>& points, const PlanePoint& first, const PlanePoint& last) {
  const std::size_t n = points.size();
  std::vector<PlanePoint> tangent(n);
  const auto unit = [](const PlanePoint& v) {
    const double size = std::hypot(v[0], v[1]);
    return PlanePoint{v[0] / size, v[1] / size};
  };
  for (std::size_t i = 1; i + 1 < n; ++i) tangent[i] = unit(points[i + 1] - points[i - 1]);
  // the chord of a parabola is the mean of the tangents at its ends
  const auto end = [&](const PlanePoint& given, const PlanePoint& chord, const PlanePoint& inner) {
    if (given[0] != 0 || given[1] != 0) return unit(given);
    const PlanePoint c = unit(chord);
    if (n < 3) return c;
    const double along = dot(inner, c);
    return PlanePoint{2 * along * c[0] - inner[0], 2 * along * c[1] - inner[1]};
  };
  tangent.front() = end(first, points[1] - points[0], tangent[1]);
  tangent.back() = end(last, points[n - 1] - points[n - 2], tangent[n - 2]);
  ContourPieces pieces;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const PlanePoint a = points[i], b = points[i + 1];
    const double third = std::hypot(b[0] - a[0], b[1] - a[1]) / 3;
    pieces.push_back(std::make_shared<CurvePiece>(std::make_shared<CubicBezier>(
        a, PlanePoint{a[0] + third * tangent[i][0], a[1] + third * tangent[i][1]},
        PlanePoint{b[0] - third * tangent[i + 1][0], b[1] - third * tangent[i + 1][1]}, b)));
  }
  return pieces;
}

ContourPieces nurbs_pieces(int degree, const std::vector<double>& knots, const std::vector<PlanePoint>& points,
                           const std::vector<double>& weights) {
  ContourPieces pieces;
  for (int span = degree; span < static_cast<int>(points.size()); ++span)
    if (knots[span + 1] > knots[span])
      pieces.push_back(std::make_shared<CurvePiece>(std::make_shared<NurbsSpan>(degree, knots, points, weights, span)));
  return pieces;
}

}  // namespace mudline
