#include <algorithm>
#include <cmath>

#include "ale/interior_motion.hpp"

namespace mudline {

namespace {

/// Matrix of the cofactors of a; its determinant.
template <int Dim>
double cofactors(const double (&a)[Dim][Dim], double (&c)[Dim][Dim]) {
  if constexpr (Dim == 2) {
    c[0][0] = a[1][1];
    c[0][1] = -a[1][0];
    c[1][0] = -a[0][1];
    c[1][1] = a[0][0];
  } else {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        c[i][j] = a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1];
      }
  }
  double det = 0;
  for (int k = 0; k < Dim; ++k) det += a[0][k] * c[0][k];
  return det;
}

template <int Dim>
double root(double content) {
  return Dim == 2 ? std::sqrt(content) : std::cbrt(content);
}

template <int Dim>
double length(const double (&v)[Dim]) {
  return Dim == 2 ? std::hypot(v[0], v[1]) : std::hypot(v[0], v[1], v[Dim - 1]);
}

/// T = sum over the corners v of x_v w_v^T for the ideal simplex: its corners are `ideal`.
template <int Dim>
struct IdealSimplex {
  double w[Dim + 1][Dim];
  IdealSimplex(const std::array<Point, Dim + 1>& ideal) {
    double edges[Dim][Dim], c[Dim][Dim];
    for (int i = 0; i < Dim; ++i)
      for (int k = 0; k < Dim; ++k) edges[i][k] = ideal[i + 1][k] - ideal[0][k];
    const double det = cofactors(edges, c), scale = root<Dim>(std::abs(det));  // size does not count
    for (int k = 0; k < Dim; ++k) {
      w[0][k] = 0;
      for (int v = 1; v <= Dim; ++v) {
        w[v][k] = c[v - 1][k] / det * scale;
        w[0][k] -= w[v][k];
      }
    }
  }
};

/// What every simplex strives for, and how much it counts.
template <int Dim>
struct Goal {
  IdealSimplex<Dim> ideal;
  double weight;
};
enum class Measure { mean_ratio, mean_ratio_squared };

/// Objective of the simplices around one vertex, a convex function of its position, and its derivatives.
template <int Dim>
struct PatchObjective {
  Measure measure;
  double value = 0, gradient[Dim] = {}, hessian[Dim][Dim] = {};
  bool valid = true;

  void add(const Goal<Dim>& goal, const Simplex& nodes, int moving, const Positions& x) {
    constexpr double power = 2.0 / Dim;
    const IdealSimplex<Dim>& ideal = goal.ideal;
    double t[Dim][Dim] = {}, c[Dim][Dim];
    for (int v = 0; v <= Dim; ++v)
      for (int i = 0; i < Dim; ++i)
        for (int k = 0; k < Dim; ++k) t[i][k] += x[nodes[v]][i] * ideal.w[v][k];
    const double det = cofactors(t, c);
    if (!(det > 0)) {
      valid = false;
      return;
    }
    // det is linear in the position that moves
    const double* w = ideal.w[moving];
    double n = 0, ddn = 0, dn[Dim] = {}, dd[Dim] = {};
    for (int i = 0; i < Dim; ++i) {
      for (int k = 0; k < Dim; ++k) {
        n += t[i][k] * t[i][k];
        dn[i] += t[i][k] * w[k];
        dd[i] += c[i][k] * w[k];
      }
      dn[i] *= 2;
      ddn += w[i] * w[i];
    }
    ddn *= 2;
    const double size = Dim == 2 ? det : std::pow(std::cbrt(det), 2), mu = n / (Dim * size);
    double dmu[Dim];
    for (int i = 0; i < Dim; ++i) dmu[i] = (dn[i] - Dim * mu * (power * size / det) * dd[i]) / (Dim * size);
    const auto second = [&](int i, int j) {
      return ((i == j ? ddn : 0.0) - power * (dn[i] * dd[j] + dd[i] * dn[j]) / det) / (Dim * size) +
             power * (power + 1) / Dim * n * dd[i] * dd[j] / (size * det * det);
    };
    // f(mu) with its first and second derivative
    const bool squared = measure == Measure::mean_ratio_squared;
    const double f = goal.weight * (squared ? mu * mu : mu), f1 = goal.weight * (squared ? 2 * mu : 1),
                 f2 = squared ? 2 * goal.weight : 0;
    value += f;
    for (int i = 0; i < Dim; ++i) {
      gradient[i] += f1 * dmu[i];
      for (int j = i; j < Dim; ++j) hessian[i][j] += f1 * second(i, j) + f2 * dmu[i] * dmu[j];
    }
  }

  /// Newton's step; false where there is none.
  bool step(double (&to)[Dim]) {
    double c[Dim][Dim];
    for (int i = 1; i < Dim; ++i)
      for (int j = 0; j < i; ++j) hessian[i][j] = hessian[j][i];
    const double det = cofactors(hessian, c);
    for (int i = 0; i < Dim; ++i) {
      double sum = 0;
      for (int k = 0; k < Dim; ++k) sum += c[k][i] * gradient[k];
      to[i] = -sum / det;
    }
    return valid && det > 0;
  }
};

/// Newton's method for one vertex after the other, until none moves much.
template <int Dim>
void descend(const InteriorMesh& mesh, const std::vector<Goal<Dim>>& goals, Measure measure, const SweepLimits& limits,
             Positions& x) {
  const auto& simplices = mesh.corners.simplices;
  const auto objective = [&](int node) {
    PatchObjective<Dim> result{measure};
    for (int t : mesh.corners.at_node[node]) {
      int moving = 0;
      while (simplices[t][moving] != node) ++moving;
      result.add(goals[t], simplices[t], moving, x);
      if (!result.valid) break;
    }
    return result;
  };
  sweep_by_colours(mesh, limits, x, [&](int node) {
    PatchObjective<Dim> now = objective(node);
    double step[Dim];
    if (!now.step(step)) return 0.0;
    const Point from = x[node];
    double size = 0;
    for (int t : mesh.corners.at_node[node]) size = std::max(size, std::abs(determinant(simplices[t], x)));
    size = root<Dim>(size);
    // rounding decides below this: leave the vertex where it is, so that a mesh at its optimum does not creep
    if (length(step) < 1e-12 * size) return 0.0;
    double factor = 1;
    for (int cut = 0; cut < 12; ++cut, factor *= 0.5) {
      for (int i = 0; i < Dim; ++i) x[node][i] = from[i] + factor * step[i];
      const PatchObjective<Dim> then = objective(node);
      // near the optimum the objective is level to its last digits, which must not decide on the step
      if (then.valid && then.value <= now.value * (1 + 1e-13)) return factor * length(step) / size;
    }
    x[node] = from;
    return 0.0;
  });
}

template <int Dim>
std::array<Point, Dim + 1> corners_of(const Simplex& t, const Positions& x) {
  std::array<Point, Dim + 1> result;
  for (int v = 0; v <= Dim; ++v) result[v] = x[t[v]];
  return result;
}

/// Of sides of length 1.
template <int Dim>
std::array<Point, Dim + 1> regular() {
  const Point c{0.5, std::sqrt(0.75), 0}, top{0.5, std::sqrt(1.0 / 12), std::sqrt(2.0 / 3)};
  if constexpr (Dim == 2)
    return {Point{0, 0, 0}, {1, 0, 0}, c};
  else
    return {Point{0, 0, 0}, {1, 0, 0}, c, top};
}

template <int Dim>
void optimise(const InteriorMesh& mesh, bool own_shapes, const SweepLimits& limits, Positions& x) {
  std::vector<Goal<Dim>> goals;
  for (const Simplex& t : mesh.corners.simplices)
    goals.push_back({own_shapes ? corners_of<Dim>(t, mesh.source) : regular<Dim>(), 1.0});
  descend(mesh, goals, Measure::mean_ratio_squared, limits, x);
}

}  // namespace

void OptimisationMotion::parameters(Parameters& p) {
  p.choice("ideal", ideal_, {{"source", Ideal::source}, {"equilateral", Ideal::equilateral}},
           "shape that every element strives for: its own in the mesh as it was made, or the regular one");
  limits_.parameters(p);
}

void OptimisationMotion::move(const InteriorMesh& mesh, Positions& x) const {
  const bool own_shapes = ideal_ == Ideal::source;
  mesh.corners.dimension() == 2 ? optimise<2>(mesh, own_shapes, limits_, x) : optimise<3>(mesh, own_shapes, limits_, x);
}

void WinslowMotion::move(const InteriorMesh& mesh, Positions& x) const {
  std::vector<Goal<2>> goals;
  for (const Simplex& t : mesh.corners.simplices)
    goals.push_back({corners_of<2>(t, mesh.source), std::abs(determinant(t, mesh.source))});
  descend(mesh, goals, Measure::mean_ratio, limits_, x);
}

}  // namespace mudline
