#pragma once

#include <memory>
#include <vector>

#include "geometry/contour_piece.hpp"
#include "tensor/curve_point.hpp"

namespace mudline {

/// A regular plane curve x(t), t in [0, 1].
class ParametricCurve {
 public:
  virtual ~ParametricCurve() = default;
  virtual CurvePoint<2> at(double t) const = 0;
};

/// A curve as a piece of a contour. Arc length by Gauss' rule over short runs; nearest point by Newton's method from
/// the nearest of the runs' ends, kept between its neighbours by bisection.
class CurvePiece : public ContourPiece {
 public:
  /// std::logic_error where the curve's first derivative vanishes.
  explicit CurvePiece(std::shared_ptr<const ParametricCurve> curve);
  double length() const override { return start_.back(); }
  PlanePoint point(double s) const override { return curve_->at(parameter(s)).x; }
  PlanePoint tangent(double s) const override;
  double curvature(double s) const override;
  double closest(const PlanePoint& x) const override;
  std::shared_ptr<const ContourPiece> mirrored() const override;

 private:
  double parameter(double s) const;
  /// Arc length between two parameters of one run.
  double arc(double from, double to) const;
  std::shared_ptr<const ParametricCurve> curve_;
  std::vector<double> start_;       // arc length at the runs' ends
  std::vector<PlanePoint> sample_;  // points there
};

/// Cubic Bezier curve.
class CubicBezier : public ParametricCurve {
 public:
  CubicBezier(PlanePoint b0, PlanePoint b1, PlanePoint b2, PlanePoint b3) : b_{b0, b1, b2, b3} {}
  CurvePoint<2> at(double t) const override;

 private:
  PlanePoint b_[4];
};

/// One span between two knots of a non-uniform rational B-spline.
class NurbsSpan : public ParametricCurve {
 public:
  /// Takes the whole spline; the span is [knots[span], knots[span + 1]], which is not empty.
  NurbsSpan(int degree, std::vector<double> knots, std::vector<PlanePoint> points, std::vector<double> weights,
            int span);
  CurvePoint<2> at(double t) const override;

 private:
  int degree_, span_;
  std::vector<double> knots_;
  std::vector<PlanePoint> points_;
  std::vector<double> weights_;
};

using ContourPieces = std::vector<std::shared_ptr<const ContourPiece>>;

/// Smooth (C1) cubic pieces through points: the tangent at a point is parallel to the line between its neighbours, the
/// handles are a third of the chord. Ends: the given directions, or (zero vectors) the slope of the parabola through
/// the last three points.
ContourPieces hermite_pieces(const std::vector<PlanePoint>& points, const PlanePoint& first = {},
                             const PlanePoint& last = {});

/// Every non-empty span of a clamped spline.
ContourPieces nurbs_pieces(int degree, const std::vector<double>& knots, const std::vector<PlanePoint>& points,
                           const std::vector<double>& weights);

}  // namespace mudline
