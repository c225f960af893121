#include "materials/point/point_control.hpp"

#include <algorithm>
#include <cmath>

#include "tensor/mat.hpp"
#include "tensor/midpoint_rule.hpp"
#include "tensor/small_lu.hpp"

namespace mudline {

namespace {

// Newton that leaves this much strain behind it in one increment (or more than twice the prescribed one) has gone
// astray: there a law with v = v0 exp(-strain) has no stiffness left and agrees to anything.
constexpr double farthest = 0.5;
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

/// The midpoint rule for f = F_{n+1} F_n^-1 of the plane, as in the finite elements.
PointMotion PointControl::motion_of(const PointIncrement& increment, const Six& change) const {
  PointMotion motion;
  motion.strain = increment.tie.strain(change);
  if (!increment.sliding) return motion;
  const double height = std::exp(strain_[1]), stretch = std::exp(change[1]);  // heights over that before
  const double slide = change[5] / height;
  const Mat<double, 2> H = {{{0.0, 2.0 * slide / (1.0 + stretch)}, {0.0, 2.0 * (stretch - 1.0) / (1.0 + stretch)}}};
  MidpointRule<2> rule;
  rule.evaluate(H, 0.0, true);
  motion.cosine = rule.rotation[0][0];
  motion.sine = rule.rotation[1][0];
  rule.increment(motion.strain.data());
  return motion;
}

/// Newton's correction of the stress-controlled components; false for a singular tangent. The rotation of a sliding
/// point is left out: it hardly depends on what is sought.
bool PointControl::correct(const PointIncrement& increment, const PointTrial& trial, Six& change) const {
  SmallLu<6> matrix;
  Six step{};
  const Six stress = increment.tie.stress(trial.stress);
  std::array<Six, 6> tangent;  // of the controlled stresses by the changes
  for (int j = 0; j < 6; ++j) {
    Six unit{}, column{};
    unit[j] = 1.0;
    const Six strain = increment.tie.strain(unit);
    for (int i = 0; i < 6; ++i)
      for (int k = 0; k < 6; ++k) column[i] += trial.tangent[6 * i + k] * strain[k];
    column = increment.tie.stress(column);
    for (int i = 0; i < 6; ++i) tangent[i][j] = column[i];
  }
  for (int i = 0; i < 6; ++i) {
    const bool sought = increment.stress_controlled[i];
    if (sought) step[i] = increment.stress[i] - stress[i];
    for (int j = 0; j < 6; ++j) {
      const double kept = i == j ? 1.0 : 0.0;  // a component that follows its strain is not corrected
      matrix.a[i][j] = sought && increment.stress_controlled[j] ? tangent[i][j] : kept;
    }
  }
  if (!matrix.factorise()) return false;
  matrix.solve(step.data());
  for (int c = 0; c < 6; ++c) change[c] += step[c];
  return largest(change) <= std::max(farthest, 2.0 * largest(increment.strain));
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
    if (!trial.ok) {
      failure_ = trial.failure;
      return false;
    }
    double residual = 0.0, scale = std::max(largest(point_.stress()), largest(trial.stress));
    const Six stress = increment.tie.stress(trial.stress);
    for (int c = 0; c < 6; ++c)
      if (increment.stress_controlled[c]) {
        residual = std::max(residual, std::abs(stress[c] - increment.stress[c]));
        scale = std::max(scale, std::abs(increment.stress[c]));
      }
    stalled = residual < 0.5 * best ? 0 : stalled + 1;
    best = std::min(best, residual);
    const bool near = residual <= tolerance_at_end * scale && (stalled > 4 || iteration + 1 == maximum_iterations);
    if (residual <= tolerance * scale || near) {
      const Six strain = increment.tie.strain(change);
      for (int c = 0; c < 6; ++c) {
        strain_[c] += strain[c];
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
  const Six stress = increment.tie.stress(point_.stress());
  for (int c = 0; c < 6; ++c) {
    first.strain[c] = second.strain[c] = 0.5 * increment.strain[c];
    first.stress[c] = 0.5 * (stress[c] + increment.stress[c]);
  }
  return advance(first, depth + 1) && advance(second, depth + 1);
}

}  // namespace mudline
