#pragma once

#include <functional>
#include <vector>

#include "ale/ghosted_mesh.hpp"

namespace mudline {

/// A smooth curve (C1, piecewise cubic) through given points, parametrised by the length s [m] of the chords between
/// them. The slope at a point is that of the parabola through it and its two neighbours, so that a kink disturbs only
/// the segments beside it.
class PathCurve {
 public:
  explicit PathCurve(Positions points);
  double length() const { return s_.back(); }
  int points() const { return static_cast<int>(points_.size()); }
  /// Parameter of the given point.
  double parameter(int point) const { return s_[point]; }
  Point at(double s) const;
  /// Linear interpolation of values given at the points.
  double interpolate(const std::vector<double>& values, double s) const;

 private:
  int segment(double s) const;
  Positions points_, slopes_;
  std::vector<double> s_;
};

/// A wanted size [m] of the sides at a place.
using SizeField = std::function<double(const Point&)>;

/// How many sides of the wanted size fit between the start of a curve and any place on it: the integral of ds / size.
class CurveMeasure {
 public:
  CurveMeasure(const PathCurve& curve, const SizeField& size);
  /// `length` [m] of the curve; `size`: by the place s along it; `samples`: number of intervals of the quadrature.
  CurveMeasure(double length, const std::function<double(double s)>& size, int samples);
  double total() const { return sum_.back(); }
  double at(double s) const;
  /// The place s [m] at which this measure is reached.
  double place(double measure) const;

 private:
  double step_;
  std::vector<double> sum_;
};

/// Places s [m] of the ends of the sides that divide a curve, as many and as long as `size` [m] asks. `parts`: into so
/// many the size is smooth.
std::vector<double> divided(double length, const std::function<double(double s)>& size, int parts);

}  // namespace mudline
