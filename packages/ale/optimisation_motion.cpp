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

template <int Dim>
std::array<Point, Dim + 1> corners_of(const Simplex& t, const Positions& x) {
  std::array<Point, Dim + 1> result;
  for (int v = 0; v <= Dim; ++v) result[v] = x[t[v]];
  return result;
}

/// The simplex with sides of length 1.
template <int Dim>
std::array<Point, Dim + 1> regular() {
  const Point c{0.5, std::sqrt(0.75), 0}, top{0.5, std::sqrt(1.0 / 12), std::sqrt(2.0 / 3)};
  if constexpr (Dim == 2)
    return {Point{0, 0, 0}, {1, 0, 0}, c};
  else
    return {Point{0, 0, 0}, {1, 0, 0}, c, top};
}

/// Newton's method for the place of one vertex, with what every simplex strives for.
template <int Dim>
class VertexOptimiser {
 public:
  VertexOptimiser(const InteriorMesh& mesh, bool own_shapes, Positions& x) : mesh_(mesh.corners), x_(x) {
    for (const Simplex& t : mesh_.simplices)
      ideals_.emplace_back(own_shapes ? corners_of<Dim>(t, mesh.source) : regular<Dim>());
  }

  /// Takes one step; returns its length as a share of the size of the simplices around.
  double improve(int node) {
    MeanRatio<Dim> now = objective(node);
    double step[Dim];
    if (!now.step(step)) return 0.0;
    const Point from = x_[node];
    double size = 0;
    for (int t : mesh_.at_node[node]) size = std::max(size, std::abs(determinant(mesh_.simplices[t], x_)));
    size = edge_of_content<Dim>(size);
    // rounding decides below this: leave the vertex where it is, so that a mesh at its optimum does not creep
    if (length(step) < 1e-12 * size) return 0.0;
    double factor = 1;
    for (int cut = 0; cut < 12; ++cut, factor *= 0.5) {
      for (int i = 0; i < Dim; ++i) x_[node][i] = from[i] + factor * step[i];
      const MeanRatio<Dim> then = objective(node);
      // near the optimum the objective is level to its last digits, which must not decide on the step
      if (then.valid && then.value <= now.value * (1 + 1e-13)) return factor * length(step) / size;
    }
    x_[node] = from;
    return 0.0;
  }

 private:
  MeanRatio<Dim> objective(int node) const {
    MeanRatio<Dim> result;
    for (int t : mesh_.at_node[node]) {
      const Simplex& simplex = mesh_.simplices[t];
      int moving = 0;
      while (simplex[moving] != node) ++moving;
      result.add(ideals_[t], moving, [&](int v) -> const Point& { return x_[simplex[v]]; });
      if (!result.valid) break;
    }
    return result;
  }

  const CornerSimplices& mesh_;
  Positions& x_;
  std::vector<IdealSimplex<Dim>> ideals_;
};

}  // namespace

void OptimisationMotion::parameters(Parameters& p) {
  p.choice("ideal", ideal_, {{"source", Ideal::source}, {"equilateral", Ideal::equilateral}},
           "shape that every element strives for: its own in the mesh as it was made, or the regular one");
  p.add("sweeps", sweeps_, "-", closed(1, 100000), "largest number of passes over the vertices");
  p.add("sweep tolerance", tolerance_, "-", positive(),
        "passes end when no vertex moves by more than this share of its elements' size");
}

/// Passes over the vertices that may move, colour after colour, to and fro. Ranks place ghosts too, so that they must
/// meet only every few colours.
template <int Dim>
void OptimisationMotion::sweep(const InteriorMesh& mesh, Positions& x) const {
  VertexOptimiser<Dim> optimiser(mesh, ideal_ == Ideal::source, x);
  const int colours = static_cast<int>(mesh.colours.size());
  for (int sweep = 0; sweep < sweeps_; ++sweep) {
    double largest = 0;
    for (int k = 0; k < colours; ++k) {
      for (int node : mesh.colours[sweep % 2 == 0 ? k : colours - 1 - k]) {
        const double moved = optimiser.improve(node);
        if (mesh.mesh.owns(node)) largest = std::max(largest, moved);
      }
      // with every colour the outermost ghosts that are still right are one layer further in
      if ((k + 1) % mesh.mesh.layers() == 0 || k + 1 == colours) mesh.mesh.fill(x);
    }
    if (mesh.mesh.largest(largest) < tolerance_) break;
  }
}

void OptimisationMotion::move(const InteriorMesh& mesh, Positions& x) const {
  mesh.corners.dimension() == 2 ? sweep<2>(mesh, x) : sweep<3>(mesh, x);
}

}  // namespace mudline
