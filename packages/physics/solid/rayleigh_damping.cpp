#include "physics/solid/rayleigh_damping.hpp"

#include "physics/element.hpp"

namespace mudline {

template <int NU>
void RayleighDamping::element_matrix(const SoilBlock& b, const StepView& view, int e,
                                     double (&k)[2 * NU][2 * NU]) const {
  double x[NU][2];
  gather<NU>(b.nodes, e, view.x_old, x);
  for (int q = 0; q < b.points; ++q) {
    PointGeometry<NU> at;
    at.compute(x, &b.u.dN(q, 0, 0), &b.u.N(q, 0), soil_->axisymmetric);
    const int row = e * b.points + q;
    const double void_ratio = view.committed->arrays[b.void_ratio](row, 0);
    const ElasticModuli m = b.material->skeleton->moduli(&view.committed->arrays[b.stress](row, 0), void_ratio,
                                                         &view.committed->arrays[b.law](row, 0));
    const double dv = at.volume(b.u.weights(q)), G = stiffness_factor_ * m.shear;
    const double lambda = stiffness_factor_ * (m.bulk - 2.0 / 3 * m.shear);
    const double mass = mass_factor_ * b.material->density(void_ratio / (1 + void_ratio));
    const double over_r = soil_->axisymmetric ? 1 / at.r : 0.0;
    for (int a = 0; a < NU; ++a)
      for (int c = 0; c < NU; ++c) {
        const double ha = b.u.N(q, a) * over_r, hc = b.u.N(q, c) * over_r;
        const double da[2] = {at.g[a][0] + ha, at.g[a][1]}, dc[2] = {at.g[c][0] + hc, at.g[c][1]};
        const double dot = at.g[a][0] * at.g[c][0] + at.g[a][1] * at.g[c][1];
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j) {
            double value = lambda * da[i] * dc[j] + G * at.g[a][j] * at.g[c][i];
            if (i == j) value += G * dot + mass * b.u.N(q, a) * b.u.N(q, c);
            if (i == 0 && j == 0) value += 2 * G * ha * hc;
            k[2 * a + i][2 * c + j] += dv * value;
          }
      }
  }
}

int RayleighDamping::residual(const StepView& view, const ResidualView& f) {
  if (!view.inertia) return 0;
  for (const SoilBlock& b : soil_->blocks)
    dispatch_pair(b.shape, b.porous(), [&](auto pair) {
      constexpr int NU = decltype(pair)::NU;
      for (int e = 0; e < b.elements; ++e) {
        double k[2 * NU][2 * NU] = {{0}}, v[2 * NU], r[2 * NU] = {0};
        element_matrix<NU>(b, view, e, k);
        gather<2 * NU>(b.dofs, e, 0, view.velocity, v);
        for (int i = 0; i < 2 * NU; ++i)
          for (int j = 0; j < 2 * NU; ++j) r[i] += k[i][j] * v[j];
        scatter_vector<2 * NU>(b.dofs, e, 0, r, f);
      }
    });
  return 0;
}

void RayleighDamping::jacobian(const StepView& view, Assembler& assembler, double weight) {
  if (!view.inertia) return;
  for (const SoilBlock& b : soil_->blocks) {
    const MatrixScatter to = assembler.scatter(b.group);
    dispatch_pair(b.shape, b.porous(), [&](auto pair) {
      constexpr int NU = decltype(pair)::NU;
      for (int e = 0; e < b.elements; ++e) {
        double k[2 * NU][2 * NU] = {{0}};
        element_matrix<NU>(b, view, e, k);
        scatter_matrix<2 * NU, 2 * NU>(to, e, 0, 0, k, weight * view.sensitivity[soil_->displacement].velocity);
      }
    });
  }
}

}  // namespace mudline
