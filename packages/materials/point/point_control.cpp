#include "materials/point/point_control.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mudline {

namespace {

constexpr int maximum_iterations = 40, maximum_cuts = 12;  // halvings of one increment: to 1/4096
// Stresses agree to this part of the largest of them. A law with substepping may jump a little where their number
// changes; what is reached then still counts when it is below the second number.
constexpr double tolerance = 1e-10, tolerance_at_end = 1e-6;

double largest(const Six& values) {
  double size = 0.0;
  for (const double v : values) size = std::max(size, std::abs(v));
  return size;
}

}  // namespace

/// Hughes and Winget's midpoint rule for f = F_{n+1} F_n^-1 of the plane, its trace replaced by ln J and its axes
/// turned to those of the end, as in the finite elements (physics/solid/kinematics.hpp).
PointMotion PointControl::motion_of(const PointIncrement& increment, const Six& change) const {
  PointMotion motion;
  motion.strain = change;
  if (!increment.sliding) return motion;
  const double height = std::exp(strain_[1]), stretch = std::exp(change[1]);  // heights over that before
  const double slide = change[5] / height;
  const double xy = 2.0 * slide / (1.0 + stretch), yy = 2.0 * (stretch - 1.0) / (1.0 + stretch);
  const double shift = (change[1] - yy) / 3.0;
  const double spin = -0.5 * xy, q = 1.0 + 0.25 * spin * spin;
  motion.cosine = (1.0 - 0.25 * spin * spin) / q;
  motion.sine = spin / q;
  // from the axes of the midpoint to those of the end
  const double cc = 1.0 / q, ss = 0.25 * spin * spin / q, cs = 0.5 * spin / q;
  motion.strain = {ss * yy - cs * xy + shift,     cc * yy + cs * xy + shift, shift, 0.0, 0.0,
                   (cc - ss) * xy - 2.0 * cs * yy};
  return motion;
}

/// Newton's correction of the stress-controlled components, with pivoting; false for a singular tangent. The rotation
/// of a sliding point is left out: it hardly depends on what is sought.
bool PointControl::correct(const PointIncrement& increment, const PointTrial& trial, Six& change) const {
  int index[6], n = 0;
  for (int c = 0; c < 6; ++c)
    if (increment.stress_controlled[c]) index[n++] = c;
  double a[6][7];
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) a[i][j] = trial.tangent[6 * index[i] + index[j]];
    a[i][n] = increment.stress[index[i]] - trial.stress[index[i]];
  }
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    if (!(std::abs(a[pivot][k]) > 0.0)) return false;
    std::swap(a[k], a[pivot]);
    for (int i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = a[i][k] / a[k][k];
      for (int j = k; j <= n; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  for (int i = 0; i < n; ++i) change[index[i]] += a[i][n] / a[i][i];
  return std::isfinite(largest(change));
}

bool PointControl::solve(const PointIncrement& increment, const Six& guess) {
  Six change = increment.strain;
  bool mixed = false;
  for (int c = 0; c < 6; ++c)
    if (increment.stress_controlled[c]) {
      change[c] = guess[c];
      mixed = true;
    }
  double best = 1e300;
  int stalled = 0;
  for (int iteration = 0; iteration < maximum_iterations; ++iteration) {
    const PointMotion motion = motion_of(increment, change);
    const PointTrial trial = point_.evaluate(motion, increment.dt, mixed);
    ++iterations_;
    if (!trial.ok) return false;
    double residual = 0.0, scale = std::max(largest(point_.stress()), largest(trial.stress));
    for (int c = 0; c < 6; ++c)
      if (increment.stress_controlled[c]) {
        residual = std::max(residual, std::abs(trial.stress[c] - increment.stress[c]));
        scale = std::max(scale, std::abs(increment.stress[c]));
      }
    stalled = residual < 0.5 * best ? 0 : stalled + 1;
    best = std::min(best, residual);
    const bool near = residual <= tolerance_at_end * scale && (stalled > 4 || iteration + 1 == maximum_iterations);
    if (residual <= tolerance * scale || near) {
      for (int c = 0; c < 6; ++c) {
        strain_[c] += change[c];
        rate_[c] = increment.dt > 0.0 ? change[c] / increment.dt : 0.0;
      }
      point_.commit(motion, increment.dt, trial);
      return true;
    }
    if (!correct(increment, trial, change)) return false;
  }
  return false;
}

bool PointControl::advance(const PointIncrement& increment, int depth) {
  Six guess{};
  for (int c = 0; c < 6; ++c) guess[c] = rate_[c] * increment.dt;
  if (solve(increment, guess) || solve(increment, {})) return true;
  if (depth == maximum_cuts) return false;
  ++cuts_;
  PointIncrement first = increment, second = increment;
  first.dt = second.dt = 0.5 * increment.dt;
  for (int c = 0; c < 6; ++c) {
    first.strain[c] = second.strain[c] = 0.5 * increment.strain[c];
    first.stress[c] = 0.5 * (point_.stress()[c] + increment.stress[c]);
  }
  return advance(first, depth + 1) && advance(second, depth + 1);
}

}  // namespace mudline
