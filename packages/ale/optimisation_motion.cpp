#include <cmath>

#include "ale/interior_motion.hpp"

namespace mudline {

namespace {

/// T = sum over the corners v of x_v w_v^T for the ideal triangle `ideal`.
struct IdealTriangle {
  double w[3][2];
  IdealTriangle(const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c) {
    const double p[2] = {b[0] - a[0], b[1] - a[1]}, q[2] = {c[0] - a[0], c[1] - a[1]};
    const double det = p[0] * q[1] - p[1] * q[0], scale = std::sqrt(std::abs(det));  // size does not count
    const double inverse[2][2] = {{q[1] / det * scale, -q[0] / det * scale}, {-p[1] / det * scale, p[0] / det * scale}};
    for (int k = 0; k < 2; ++k) {
      w[1][k] = inverse[0][k];
      w[2][k] = inverse[1][k];
      w[0][k] = -w[1][k] - w[2][k];
    }
  }
};

/// What every triangle strives for, and how much it counts.
struct Goal {
  IdealTriangle ideal;
  double weight;
};
enum class Measure { mean_ratio, mean_ratio_squared };

/// Objective of the triangles around one vertex, a convex function of its position, and its derivatives.
struct PatchObjective {
  Measure measure;
  double value = 0, gradient[2] = {0, 0}, hessian[3] = {0, 0, 0};  // xx, xy, yy
  bool valid = true;

  void add(const Goal& goal, const std::array<int, 3>& nodes, int moving, const Positions& x) {
    const IdealTriangle& ideal = goal.ideal;
    double t[2][2] = {{0, 0}, {0, 0}};
    for (int v = 0; v < 3; ++v)
      for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 2; ++k) t[i][k] += x[nodes[v]][i] * ideal.w[v][k];
    const double det = t[0][0] * t[1][1] - t[0][1] * t[1][0];
    if (!(det > 0)) {
      valid = false;
      return;
    }
    const double* w = ideal.w[moving];
    const double n = t[0][0] * t[0][0] + t[0][1] * t[0][1] + t[1][0] * t[1][0] + t[1][1] * t[1][1];
    const double dn[2] = {2 * (t[0][0] * w[0] + t[0][1] * w[1]), 2 * (t[1][0] * w[0] + t[1][1] * w[1])};
    const double dd[2] = {w[0] * t[1][1] - w[1] * t[1][0], t[0][0] * w[1] - t[0][1] * w[0]};
    const double mu = n / (2 * det), ddn = 2 * (w[0] * w[0] + w[1] * w[1]);
    double dmu[2], hmu[3];
    for (int i = 0; i < 2; ++i) dmu[i] = (dn[i] - 2 * mu * dd[i]) / (2 * det);
    const auto second = [&](int i, int j) {
      return ((i == j ? ddn : 0.0) - (dn[i] * dd[j] + dd[i] * dn[j]) / det) / (2 * det) +
             n * dd[i] * dd[j] / (det * det * det);
    };
    hmu[0] = second(0, 0);
    hmu[1] = second(0, 1);
    hmu[2] = second(1, 1);
    // f(mu) with its first and second derivative
    const bool squared = measure == Measure::mean_ratio_squared;
    const double f = goal.weight * (squared ? mu * mu : mu), f1 = goal.weight * (squared ? 2 * mu : 1),
                 f2 = squared ? 2 * goal.weight : 0;
    value += f;
    for (int i = 0; i < 2; ++i) gradient[i] += f1 * dmu[i];
    hessian[0] += f1 * hmu[0] + f2 * dmu[0] * dmu[0];
    hessian[1] += f1 * hmu[1] + f2 * dmu[0] * dmu[1];
    hessian[2] += f1 * hmu[2] + f2 * dmu[1] * dmu[1];
  }
};

/// Newton's method for one vertex after the other, until none moves much.
void descend(const InteriorMesh& mesh, const std::vector<Goal>& goals, Measure measure, const SweepLimits& limits,
             Positions& x) {
  const auto& triangles = mesh.corners.triangles;
  const auto objective = [&](int node) {
    PatchObjective result{measure};
    for (int t : mesh.corners.at_node[node]) {
      int moving = 0;
      while (triangles[t][moving] != node) ++moving;
      result.add(goals[t], triangles[t], moving, x);
      if (!result.valid) break;
    }
    return result;
  };
  sweep_by_colours(mesh, limits, x, [&](int node) {
    const PatchObjective now = objective(node);
    const double det = now.hessian[0] * now.hessian[2] - now.hessian[1] * now.hessian[1];
    if (!now.valid || !(det > 0)) return 0.0;
    const double step[2] = {-(now.hessian[2] * now.gradient[0] - now.hessian[1] * now.gradient[1]) / det,
                            -(now.hessian[0] * now.gradient[1] - now.hessian[1] * now.gradient[0]) / det};
    const std::array<double, 2> from = x[node];
    double size = 0;
    for (int t : mesh.corners.at_node[node]) size = std::max(size, std::abs(twice_area(triangles[t], x)));
    size = std::sqrt(size);
    // rounding decides below this: leave the vertex where it is, so that a mesh at its optimum does not creep
    if (std::hypot(step[0], step[1]) < 1e-9 * size) return 0.0;
    double factor = 1;
    for (int cut = 0; cut < 12; ++cut, factor *= 0.5) {
      x[node] = {from[0] + factor * step[0], from[1] + factor * step[1]};
      const PatchObjective then = objective(node);
      if (then.valid && then.value <= now.value) return factor * std::hypot(step[0], step[1]) / size;
    }
    x[node] = from;
    return 0.0;
  });
}

}  // namespace

void OptimisationMotion::parameters(Parameters& p) {
  p.choice("ideal", ideal_, {{"source", Ideal::source}, {"equilateral", Ideal::equilateral}},
           "shape that every element strives for: its own in the mesh as it was made, or the regular one");
  limits_.parameters(p);
}

void OptimisationMotion::move(const InteriorMesh& mesh, Positions& x) const {
  std::vector<Goal> goals;
  for (const auto& t : mesh.corners.triangles) {
    if (ideal_ == Ideal::source)
      goals.push_back({{mesh.source[t[0]], mesh.source[t[1]], mesh.source[t[2]]}, 1.0});
    else
      goals.push_back({{{0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}}, 1.0});
  }
  descend(mesh, goals, Measure::mean_ratio_squared, limits_, x);
}

void WinslowMotion::move(const InteriorMesh& mesh, Positions& x) const {
  std::vector<Goal> goals;
  for (const auto& t : mesh.corners.triangles)
    goals.push_back({{mesh.source[t[0]], mesh.source[t[1]], mesh.source[t[2]]}, std::abs(twice_area(t, mesh.source))});
  descend(mesh, goals, Measure::mean_ratio, limits_, x);
}

}  // namespace mudline
