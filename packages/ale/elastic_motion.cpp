#include <algorithm>
#include <cmath>

#include "ale/interior_motion.hpp"
#include "discretisation/cell_map.hpp"
#include "tensor/mat.hpp"

namespace mudline {

namespace {

/// Linear elastic simplices, matrix-free: y = K u at this rank's free nodes; u is given at all nodes.
template <int Dim>
class ElasticMesh {
 public:
  ElasticMesh(const InteriorMesh& mesh, const Positions& from, double poisson)
      : mesh_(mesh), lambda_(poisson / ((1 + poisson) * (1 - 2 * poisson))), shear_(0.5 / (1 + poisson)) {
    // With Young's modulus E = 1 / size the size cancels in the element integrals.
    diagonal_.assign(Dim * mesh.movable.size(), 0.0);
    for (int i = 0; i < mesh.corners.of_elements; ++i) {
      const Simplex& t = mesh.corners.simplices[i];
      CellMap<Dim> map;
      Mat<double, Dim> edges;  // dx_i / dxi_k
      for (int i = 0; i < Dim; ++i)
        for (int k = 0; k < Dim; ++k) edges[i][k] = from[t[k + 1]][i] - from[t[0]][i];
      map.compute(edges);
      Gradients g{};
      for (int i = 0; i < Dim; ++i)
        for (int k = 0; k < Dim; ++k) {
          g[k + 1][i] = map.inverse[k][i];
          g[0][i] -= map.inverse[k][i];
        }
      for (int a = 0; a <= Dim; ++a) {
        double square = 0;
        for (int i = 0; i < Dim; ++i) square += g[a][i] * g[a][i];
        for (int i = 0; i < Dim; ++i)
          diagonal_[Dim * t[a] + i] += (lambda_ + shear_) * g[a][i] * g[a][i] + shear_ * square;
      }
      gradients_.push_back(g);
    }
  }

  std::vector<double> apply(const std::vector<double>& u) const {
    std::vector<double> y(u.size(), 0.0);
    for (std::size_t e = 0; e < gradients_.size(); ++e) {
      const Simplex& t = mesh_.corners.simplices[e];
      const Gradients& g = gradients_[e];
      Mat<double, Dim> slope = {};
      double divergence = 0;  // divergence of u; slope holds du_i / dx_j
      for (int a = 0; a <= Dim; ++a)
        for (int i = 0; i < Dim; ++i)
          for (int j = 0; j < Dim; ++j) slope[i][j] += u[Dim * t[a] + i] * g[a][j];
      for (int i = 0; i < Dim; ++i) divergence += slope[i][i];
      for (int a = 0; a <= Dim; ++a)
        for (int i = 0; i < Dim; ++i) {
          double force = lambda_ * divergence * g[a][i];
          for (int j = 0; j < Dim; ++j) force += shear_ * (slope[i][j] + slope[j][i]) * g[a][j];
          y[Dim * t[a] + i] += force;
        }
    }
    for (std::size_t i = 0; i < u.size(); ++i)
      if (!moves(i)) y[i] = 0;
    return y;
  }
  /// Whether a component belongs to a vertex of this rank that may move.
  bool moves(std::size_t i) const {
    const int node = static_cast<int>(i / Dim);
    return mesh_.movable[node] && mesh_.mesh.owns(node);
  }
  double diagonal(std::size_t i) const { return diagonal_[i]; }

 private:
  using Gradients = std::array<Vec<double, Dim>, Dim + 1>;  // of the corners' shape functions [1/m]
  const InteriorMesh& mesh_;
  double lambda_, shear_;
  std::vector<Gradients> gradients_;
  std::vector<double> diagonal_;
};

/// Dot product over this rank's free nodes: the vectors are zero elsewhere.
double dot(const GhostedMesh& mesh, const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return mesh.sum(sum);
}

template <int Dim>
void move_elastically(const InteriorMesh& mesh, const Positions& from, double poisson, Positions& x) {
  const ElasticMesh<Dim> elastic(mesh, from, poisson);
  const std::size_t n = Dim * mesh.movable.size();
  std::vector<double> u(n), r, z(n, 0.0), p;
  for (std::size_t i = 0; i < n; ++i) u[i] = x[i / Dim][i % Dim] - from[i / Dim][i % Dim];
  r = elastic.apply(u);
  for (double& value : r) value = -value;
  const auto precondition = [&] {
    for (std::size_t i = 0; i < n; ++i) z[i] = elastic.moves(i) ? r[i] / elastic.diagonal(i) : 0.0;
  };
  precondition();
  p = z;
  double rz = dot(mesh.mesh, r, z);
  const double goal = 1e-20 * rz, all = mesh.mesh.sum(static_cast<double>(Dim * mesh.mesh.owned_nodes().size()));
  for (int k = 0; k < 20 * static_cast<int>(std::sqrt(all)); ++k) {
    if (!(rz > goal)) break;
    std::vector<double> around = p;
    mesh.mesh.fill(around, Dim);
    const std::vector<double> kp = elastic.apply(around);
    const double alpha = rz / dot(mesh.mesh, p, kp);
    for (std::size_t i = 0; i < n; ++i) {
      u[i] += alpha * p[i];
      r[i] -= alpha * kp[i];
    }
    precondition();
    const double next = dot(mesh.mesh, r, z), beta = next / rz;
    rz = next;
    for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + beta * p[i];
  }
  for (std::size_t i = 0; i < n; ++i)
    if (elastic.moves(i)) x[i / Dim][i % Dim] = from[i / Dim][i % Dim] + u[i];
  mesh.mesh.fill(x);
}

}  // namespace

void ElasticMotion::parameters(Parameters& p) {
  p.choice("from", from_, {{"source", From::source}, {"present", From::present}},
           "mesh whose displacement is sought: the one that was made, which leaves no trace of the path, or the "
           "present one");
  p.add("Poisson's ratio", poisson_, "-", half_open(0, 0.5), "of the fictitious elastic body");
}

void ElasticMotion::move(const InteriorMesh& mesh, Positions& x) const {
  const Positions& from = from_ == From::source ? mesh.source : mesh.before;
  mesh.corners.dimension() == 2 ? move_elastically<2>(mesh, from, poisson_, x)
                                : move_elastically<3>(mesh, from, poisson_, x);
}

}  // namespace mudline
