#include <algorithm>
#include <cmath>

#include "ale/interior_motion.hpp"
#include "ale/mean_ratio.hpp"

namespace mudline {

namespace {

template <int Dim>
double length(const double (&v)[Dim]) {
  return Dim == 2 ? std::hypot(v[0], v[1]) : std::hypot(v[0], v[1], v[Dim - 1]);
}

/// What every simplex strives for, and how much it counts.
template <int Dim>
struct Goal {
  IdealSimplex<Dim> ideal;
  double weight;
};

/// Newton's method for one vertex after the other, until none moves much.
template <int Dim>
void descend(const InteriorMesh& mesh, const std::vector<Goal<Dim>>& goals, Measure measure, const SweepLimits& limits,
             Positions& x) {
  const auto& simplices = mesh.corners.simplices;
  const auto objective = [&](int node) {
    MeanRatio<Dim> result{measure};
    for (int t : mesh.corners.at_node[node]) {
      int moving = 0;
      while (simplices[t][moving] != node) ++moving;
      result.add(goals[t].ideal, goals[t].weight, moving, [&](int v) -> const Point& { return x[simplices[t][v]]; });
      if (!result.valid) break;
    }
    return result;
  };
  sweep_by_colours(mesh, limits, x, [&](int node) {
    MeanRatio<Dim> now = objective(node);
    double step[Dim];
    if (!now.step(step)) return 0.0;
    const Point from = x[node];
    double size = 0;
    for (int t : mesh.corners.at_node[node]) size = std::max(size, std::abs(determinant(simplices[t], x)));
    size = edge_of_content<Dim>(size);
    // rounding decides below this: leave the vertex where it is, so that a mesh at its optimum does not creep
    if (length(step) < 1e-12 * size) return 0.0;
    double factor = 1;
    for (int cut = 0; cut < 12; ++cut, factor *= 0.5) {
      for (int i = 0; i < Dim; ++i) x[node][i] = from[i] + factor * step[i];
      const MeanRatio<Dim> then = objective(node);
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
    goals.push_back({IdealSimplex<Dim>(own_shapes ? corners_of<Dim>(t, mesh.source) : regular<Dim>()), 1.0});
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
    goals.push_back({IdealSimplex<2>(corners_of<2>(t, mesh.source)), std::abs(determinant(t, mesh.source))});
  descend(mesh, goals, Measure::mean_ratio, limits_, x);
}

}  // namespace mudline
