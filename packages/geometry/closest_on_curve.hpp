#pragma once

#include <cmath>

#include "tensor/curve_point.hpp"

namespace mudline {

/// Parameters between which a curve has one closest point, and the one to begin with.
struct CurveBracket {
  double low, high, start;
  double square;  // squared distance at the start [m2]
};

/// The bracket around the closest of samples at equal steps from `low` to `high`. `square(i, t)`: squared distance of
/// sample i, from 0 to `steps`, which has the parameter t [m2].
template <class Square>
CurveBracket around_closest_sample(double low, double high, int steps, const Square& square) {
  const auto at = [&](int i) { return i <= 0 ? low : i >= steps ? high : low + (high - low) * i / steps; };
  int nearest = 0;
  double least = 1e300;
  for (int i = 0; i <= steps; ++i) {
    const double here = square(i, at(i));
    if (here >= least) continue;
    least = here;
    nearest = i;
  }
  return {at(nearest - 1), at(nearest + 1), at(nearest), least};
}

/// The parameter of a curve's closest point to x, by Newton's method, held in the bracket by bisection. `curve(t)`
/// gives a CurvePoint. Where the curve ends at the bracket's start and leads away from x, it is exactly that end.
template <class Curve, int D>
double closest_on_curve(const Curve& curve, const Vec<double, D>& x, const CurveBracket& bracket) {
  double low = bracket.low, high = bracket.high, t = bracket.start;
  for (int i = 0; i < 60; ++i) {
    const CurvePoint<D> p = curve(t);
    const Vec<double, D> offset = x - p.x;
    const double ahead = dot(offset, p.d), slope = dot(offset, p.dd) - dot(p.d, p.d);
    if ((t == low && ahead <= 0) || (t == high && ahead >= 0)) break;
    (ahead > 0 ? low : high) = t;
    double next = t - ahead / slope;
    if (!(slope < 0) || !(next >= low && next <= high)) next = 0.5 * (low + high);
    const double step = next - t;
    t = next;
    if (std::abs(step) < 1e-15) break;
  }
  return t;
}

}  // namespace mudline
