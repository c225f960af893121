#include "discretisation/piecewise_polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/pi.hpp"

namespace mudline {

namespace {

constexpr int degree = 12;
constexpr int deepest = 44;  // most halvings: an interval around a corner then has 1e-13 of the curve's length

class Fit {
 public:
  Fit(const std::function<PlanePoint(double)>& f, double tolerance) : f_(f), tolerance_(tolerance) {}

  /// The interpolant on [from, to]; none where it misses the tolerance halfway between its nodes.
  std::optional<PolynomialRun> run(double from, double to) const {
    std::vector<PlanePoint> values;
    for (int j = 0; j <= degree; ++j) values.push_back(f_(place(from, to, node(j))));
    PolynomialRun result;
    for (int k = 0; k <= degree; ++k) {
      PlanePoint sum{0, 0};
      for (int j = 0; j <= degree; ++j)
        for (int i = 0; i < 2; ++i)
          sum[i] += (j == 0 || j == degree ? 0.5 : 1.0) * values[j][i] * std::cos(pi * j * k / degree);
      for (double& c : sum) c *= (k == 0 || k == degree ? 1.0 : 2.0) / degree;
      result.coefficients.push_back(sum);
    }
    trim(result.coefficients);
    for (int j = 0; j < degree; ++j) {
      const double t = node(j + 0.5);
      const PlanePoint exact = f_(place(from, to, t)), here = result.at(t).x;
      if (!(std::hypot(here[0] - exact[0], here[1] - exact[1]) <= tolerance_)) return std::nullopt;
    }
    return result;
  }

  /// Adds the ends, after `from`, of intervals in which one run is enough. False where halving does not find them.
  bool divide(double from, double to, int depth, std::vector<double>& ends) const {
    if (run(from, to)) {
      ends.push_back(to);
      return true;
    }
    const double middle = 0.5 * (from + to);
    return depth < deepest && divide(from, middle, depth + 1, ends) && divide(middle, to, depth + 1, ends);
  }

 private:
  /// Chebyshev's extreme points, from 1 at j = 0 to 0. They include both ends, so that runs join.
  static double node(double j) { return 0.5 * (1 + std::cos(pi * j / degree)); }
  static double place(double from, double to, double t) { return t == 1 ? to : from + t * (to - from); }
  /// Drops coefficients that are only rounding, which second derivatives would magnify.
  static void trim(std::vector<PlanePoint>& c) {
    double size = 0;
    for (const PlanePoint& a : c) size = std::max(size, std::hypot(a[0], a[1]));
    while (c.size() > 2 && std::hypot(c.back()[0], c.back()[1]) < 4e-16 * size) c.pop_back();
  }

  const std::function<PlanePoint(double)>& f_;
  double tolerance_;
};

}  // namespace

CurvePoint<2> PolynomialRun::at(double t) const {
  const double s = 2 * t - 1;
  // T, T' and T'' by their recurrences; d/dt = 2 d/ds
  double T[2] = {1, s}, D[2] = {0, 1}, S[2] = {0, 0};
  CurvePoint<2> result{};
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    for (int i = 0; i < 2; ++i) {
      result.x[i] += coefficients[k][i] * T[0];
      result.d[i] += 2 * coefficients[k][i] * D[0];
      result.dd[i] += 4 * coefficients[k][i] * S[0];
    }
    const double next = 2 * s * T[1] - T[0], next_d = 2 * T[1] + 2 * s * D[1] - D[0],
                 next_s = 4 * D[1] + 2 * s * S[1] - S[0];
    T[0] = T[1], D[0] = D[1], S[0] = S[1];
    T[1] = next, D[1] = next_d, S[1] = next_s;
  }
  return result;
}

PolynomialRun PolynomialRun::reversed() const {
  PolynomialRun result = *this;
  for (std::size_t k = 1; k < result.coefficients.size(); k += 2)
    for (double& c : result.coefficients[k]) c = -c;
  return result;
}

std::vector<PolynomialRun> polynomial_runs(const std::function<PlanePoint(double)>& f, double from, double to,
                                           double tolerance) {
  const Fit fit(f, tolerance);
  std::vector<double> ends;
  if (!fit.divide(from, to, 0, ends)) return {};
  // Halving has cut around every jump; the intervals between two jumps are merged again.
  std::vector<PolynomialRun> result;
  double begin = from;
  for (std::size_t i = 0; i < ends.size();) {
    PolynomialRun longest = *fit.run(begin, ends[i]);
    std::size_t next = i + 1;
    for (; next < ends.size(); ++next) {
      const auto longer = fit.run(begin, ends[next]);
      if (!longer) break;
      longest = *longer;
    }
    result.push_back(longest);
    begin = ends[next - 1];
    i = next;
  }
  return result;
}

}  // namespace mudline
