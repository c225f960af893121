#include <algorithm>
#include <cmath>

#include "ale/interior_motion.hpp"
#include "core/pi.hpp"

namespace mudline {

namespace {

/// Linear elastic triangles, matrix-free: y = K u for this rank's free nodes, u given everywhere.
class ElasticMesh {
 public:
  ElasticMesh(const InteriorMesh& mesh, const Positions& from, double poisson) : mesh_(mesh) {
    // E = 1 / area cancels the area of the integral
    const double lambda = poisson / ((1 + poisson) * (1 - 2 * poisson)), shear = 0.5 / (1 + poisson);
    diagonal_.assign(2 * mesh.movable.size(), 0.0);
    for (int i = 0; i < mesh.corners.of_elements; ++i) {
      const auto& t = mesh.corners.triangles[i];
      Stiffness k{};
      const double area2 = twice_area(t, from);
      double g[3][2];
      for (int a = 0; a < 3; ++a) {
        const auto &b = from[t[(a + 1) % 3]], &c = from[t[(a + 2) % 3]];
        g[a][0] = (b[1] - c[1]) / area2;
        g[a][1] = (c[0] - b[0]) / area2;
      }
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
              k[2 * a + i][2 * b + j] = lambda * g[a][i] * g[b][j] + shear * g[a][j] * g[b][i] +
                                        (i == j ? shear * (g[a][0] * g[b][0] + g[a][1] * g[b][1]) : 0.0);
      for (int a = 0; a < 3; ++a)
        for (int i = 0; i < 2; ++i) diagonal_[2 * t[a] + i] += k[2 * a + i][2 * a + i];
      stiffness_.push_back(k);
    }
  }

  std::vector<double> apply(const std::vector<double>& u) const {
    std::vector<double> y(u.size(), 0.0);
    for (std::size_t e = 0; e < stiffness_.size(); ++e) {
      const auto& t = mesh_.corners.triangles[e];
      for (int a = 0; a < 6; ++a) {
        double sum = 0;
        for (int b = 0; b < 6; ++b) sum += stiffness_[e][a][b] * u[2 * t[b / 2] + b % 2];
        y[2 * t[a / 2] + a % 2] += sum;
      }
    }
    for (std::size_t i = 0; i < u.size(); ++i)
      if (!moves(i)) y[i] = 0;
    return y;
  }
  /// Whether a component belongs to a vertex of this rank that may move.
  bool moves(std::size_t i) const {
    const int node = static_cast<int>(i / 2);
    return mesh_.movable[node] && mesh_.mesh.owns(node);
  }
  double diagonal(std::size_t i) const { return diagonal_[i]; }

 private:
  using Stiffness = std::array<std::array<double, 6>, 6>;
  const InteriorMesh& mesh_;
  std::vector<Stiffness> stiffness_;
  std::vector<double> diagonal_;
};

/// Of what is zero but at this rank's free nodes.
double dot(const GhostedMesh& mesh, const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return mesh.sum(sum);
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
  const ElasticMesh elastic(mesh, from, poisson_);
  const std::size_t n = 2 * mesh.movable.size();
  std::vector<double> u(n), r, z(n, 0.0), p;
  for (std::size_t i = 0; i < n; ++i) u[i] = x[i / 2][i % 2] - from[i / 2][i % 2];
  r = elastic.apply(u);
  for (double& value : r) value = -value;
  const auto precondition = [&] {
    for (std::size_t i = 0; i < n; ++i) z[i] = elastic.moves(i) ? r[i] / elastic.diagonal(i) : 0.0;
  };
  precondition();
  p = z;
  double rz = dot(mesh.mesh, r, z);
  const double goal = 1e-20 * rz, all = mesh.mesh.sum(static_cast<double>(2 * mesh.mesh.owned_nodes().size()));
  for (int k = 0; k < 20 * static_cast<int>(std::sqrt(all)) && rz > goal; ++k) {
    std::vector<double> around = p;
    mesh.mesh.fill(around, 2);
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
    if (elastic.moves(i)) x[i / 2][i % 2] = from[i / 2][i % 2] + u[i];
  mesh.mesh.fill(x);
}

void ArtificialMotion::parameters(Parameters& p) {
  ElasticMotion::parameters(p);
  p.add("amplitude", amplitude_, "-", closed(0, 0.25),
        "of the swing, as a share of the smallest side at the vertex in the source's mesh");
  p.required("period", period_, "s", positive(), "of the swing");
}

void ArtificialMotion::move(const InteriorMesh& mesh, Positions& x) const {
  ElasticMotion::move(mesh, x);
  const double turn = 2 * pi;
  for (int node : mesh.mesh.owned_nodes()) {
    if (!mesh.movable[node]) continue;
    double side = 1e300;
    for (int t : mesh.corners.at_node[node])
      for (int k : mesh.corners.triangles[t])
        if (k != node)
          side = std::min(
              side, std::hypot(mesh.source[k][0] - mesh.source[node][0], mesh.source[k][1] - mesh.source[node][1]));
    const double swing = amplitude_ * side * std::sin(turn * mesh.time / period_),
                 direction = 2.4 * static_cast<double>(mesh.mesh.node_id(node));
    x[node][0] += swing * std::cos(direction);
    x[node][1] += swing * std::sin(direction);
  }
  mesh.mesh.fill(x);
}

}  // namespace mudline
