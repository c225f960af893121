#include "physics/solid/stress_divergence.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "discretisation/agree.hpp"
#include "physics/solid/kinematics.hpp"
#include "physics/solid/stress_update.hpp"

namespace mudline {

namespace {

/// Total stress xx yy zz xy at a point.
template <int NP>
KOKKOS_INLINE_FUNCTION void total_stress(const double* effective, const double* Np, const double* p, double alpha,
                                         double (&s)[4]) {
  double pressure = 0;
  for (int c = 0; c < NP; ++c) pressure += Np[c] * p[c];
  s[0] = effective[0] - alpha * pressure;
  s[1] = effective[1] - alpha * pressure;
  s[2] = effective[2] - alpha * pressure;
  s[3] = effective[5];
}

template <int NU, int NP>
struct StressKernel {
  bool axisymmetric;
  int points;
  double alpha;
  Kokkos::View<double*> weights;
  Kokkos::View<double**, Kokkos::LayoutRight> N, Np;
  Kokkos::View<double***, Kokkos::LayoutRight> dN;
  Kokkos::View<int**, Kokkos::LayoutRight> nodes;
  ElementDofs dofs;
  PointView stress, stress_old;
  ConstCoordinateView x_old, x_end;
  ConstNodalView value_old, value;

  StressKernel(const Soil& soil, const SoilBlock& b, const StepView& view)
      : axisymmetric(soil.axisymmetric),
        points(b.points),
        alpha(b.material->biot_coefficient),
        weights(b.u.weights),
        N(b.u.N),
        Np(b.p.N),
        dN(b.u.dN),
        nodes(b.nodes),
        dofs(b.dofs),
        stress(view.trial->arrays[b.stress]),
        stress_old(view.committed->arrays[b.stress]),
        x_old(view.x_old),
        x_end(view.x_end),
        value_old(view.value_old),
        value(view.value_end) {}

  KOKKOS_INLINE_FUNCTION void gather_pressure(int e, double (&p)[NP > 0 ? NP : 1]) const {
    p[0] = 0;
    for (int c = 0; c < NP; ++c) p[c] = value(dofs(e, 2 * NU + c));
  }

  /// What acts in the step is what the changes of effective stress and of pore pressure exert, each by itself: they may
  /// cancel, as in consolidation.
  KOKKOS_INLINE_FUNCTION void residual(int e, const ResidualView& f) const {
    double x[NU][2], p[NP > 0 ? NP : 1], r[2 * NU] = {0}, skeleton[2 * NU] = {0}, water[2 * NU] = {0};
    gather<NU>(nodes, e, x_end, x);
    gather_pressure(e, p);
    double dp[NP > 0 ? NP : 1];
    for (int c = 0; c < NP; ++c) dp[c] = p[c] - value_old(dofs(e, 2 * NU + c));
    for (int q = 0; q < points; ++q) {
      PointGeometry<NU> geometry;
      geometry.compute(x, &dN(q, 0, 0), &N(q, 0), axisymmetric);
      double s[4];
      total_stress<NP>(&stress(e * points + q, 0), NP > 0 ? &Np(q, 0) : nullptr, p, alpha, s);
      double ds[4], change = 0;
      constexpr int full[4] = {0, 1, 2, 5};
      for (int i = 0; i < 4; ++i) ds[i] = stress(e * points + q, full[i]) - stress_old(e * points + q, full[i]);
      for (int c = 0; c < NP; ++c) change -= alpha * Np(q, c) * dp[c];
      const double dv = geometry.volume(weights(q)), over_r = axisymmetric && geometry.ok ? 1 / geometry.r : 0.0;
      for (int a = 0; a < NU; ++a) {
        const double g0 = dv * geometry.g[a][0], g1 = dv * geometry.g[a][1], hoop = dv * over_r * N(q, a);
        r[2 * a] += s[0] * g0 + s[3] * g1 + s[2] * hoop;
        r[2 * a + 1] += s[3] * g0 + s[1] * g1;
        skeleton[2 * a] += ds[0] * g0 + ds[3] * g1 + ds[2] * hoop;
        skeleton[2 * a + 1] += ds[3] * g0 + ds[1] * g1;
        water[2 * a] += change * (g0 + hoop);
        water[2 * a + 1] += change * g1;
      }
    }
    for (int a = 0; a < 2 * NU; ++a) skeleton[a] = std::abs(skeleton[a]) + std::abs(water[a]);
    scatter_vector<2 * NU>(dofs, e, 0, r, skeleton, f);
  }

  /// Adds one point to the element tangent. D: 36 values of the law.
  KOKKOS_INLINE_FUNCTION void tangent_point(int q, const double (&xo)[NU][2], const double (&x)[NU][2],
                                            const double (&du)[NU][2], const double* p, const double* effective,
                                            const double* D, double (&k)[2 * NU][2 * NU],
                                            double (&kp)[2 * NU][NP > 0 ? NP : 1]) const {
    PointGeometry<NU> at;
    at.compute(x, &dN(q, 0, 0), &N(q, 0), axisymmetric);
    IncrementKinematics<NU> inc;
    inc.compute(xo, x, du, &dN(q, 0, 0), &N(q, 0), axisymmetric);
    double s[4], de0[4];
    total_stress<NP>(effective, NP > 0 ? &Np(q, 0) : nullptr, p, alpha, s);
    inc.strain(de0);
    const double dv = at.volume(weights(q));
    const double over_r = axisymmetric ? 1.0 / at.r : 0.0;
    constexpr int full[4] = {0, 1, 2, 5};
    // d sigma' = D (de - dtheta [W, strain]) + dtheta [W, sigma'], exact for an isotropic law
    const double spin_stress[4] = {-2 * effective[5], 2 * effective[5], 0, effective[0] - effective[1]};
    const double spin_strain[4] = {-de0[3], de0[3], 0, 2 * (de0[0] - de0[1])};
    double D4[4][4], shift[4];
    for (int i = 0; i < 4; ++i) {
      shift[i] = spin_stress[i];
      for (int j = 0; j < 4; ++j) {
        D4[i][j] = D[6 * full[i] + full[j]];
        shift[i] -= D4[i][j] * spin_strain[j];
      }
    }
    for (int b = 0; b < NU; ++b) {
      const double g0 = at.g[b][0], g1 = at.g[b][1], shape = N(q, b) * over_r;
      const double traction[2] = {s[0] * g0 + s[3] * g1, s[3] * g0 + s[1] * g1};
      for (int j = 0; j < 2; ++j) {
        double de[4], dtheta;
        inc.variation(b, j, de, dtheta);
        const double divergence = at.g[b][j] + (j == 0 ? shape : 0.0);
        double ds[4];
        for (int i = 0; i < 4; ++i) {
          ds[i] = shift[i] * dtheta + s[i] * divergence;
          for (int l = 0; l < 4; ++l) ds[i] += D4[i][l] * de[l];
        }
        // P_il = d sigma_il + sigma_il div - (sigma g_b)_i delta_lj
        double P[2][2] = {{ds[0], ds[3]}, {ds[3], ds[1]}};
        P[0][j] -= traction[0];
        P[1][j] -= traction[1];
        const double hoop = over_r * (ds[2] - (j == 0 ? s[2] * shape : 0.0));
        for (int a = 0; a < NU; ++a) {
          k[2 * a][2 * b + j] += dv * (P[0][0] * at.g[a][0] + P[0][1] * at.g[a][1] + hoop * N(q, a));
          k[2 * a + 1][2 * b + j] += dv * (P[1][0] * at.g[a][0] + P[1][1] * at.g[a][1]);
        }
      }
    }
    for (int a = 0; a < NU; ++a)
      for (int c = 0; c < NP; ++c) {
        const double factor = -dv * alpha * Np(q, c);
        kp[2 * a][c] += factor * (at.g[a][0] + N(q, a) * over_r);
        kp[2 * a + 1][c] += factor * at.g[a][1];
      }
  }

  KOKKOS_INLINE_FUNCTION void tangent(int e, const PointView& D, int first, const MatrixScatter& to,
                                      double weight) const {
    double xo[NU][2], x[NU][2], du[NU][2], p[NP > 0 ? NP : 1], k[2 * NU][2 * NU] = {{0}},
                                                                             kp[2 * NU][NP > 0 ? NP : 1] = {{0}};
    gather<NU>(nodes, e, x_old, xo);
    gather<NU>(nodes, e, x_end, x);
    gather_increment<NU>(dofs, e, value_old, value, du);
    gather_pressure(e, p);
    for (int q = 0; q < points; ++q)
      tangent_point(q, xo, x, du, p, &stress(e * points + q, 0), &D((e - first) * points + q, 0), k, kp);
    scatter_matrix<2 * NU, 2 * NU>(to, e, 0, 0, k, weight);
    if constexpr (NP > 0) scatter_matrix<2 * NU, NP>(to, e, 0, 2 * NU, kp, weight);
  }
};

}  // namespace

int StressDivergence::residual(const StepView& view, const ResidualView& f) {
  int failures = 0;
  failure_.clear();
  for (const SoilBlock& b : soil_->blocks) {
    StressUpdate update(*soil_, b, false);
    for (int first = 0; first < b.elements; first += StressUpdate::batch)
      failures += update.run(view, first, std::min(first + StressUpdate::batch, b.elements));
    if (failure_.empty()) failure_ = update.failure();
    dispatch_pair(b.shape, b.porous(), [&](auto pair) {
      const StressKernel<decltype(pair)::NU, decltype(pair)::NP> kernel(*soil_, b, view);
      Kokkos::parallel_for(
          "stress divergence", Kokkos::RangePolicy<>(0, b.elements), KOKKOS_LAMBDA(int e) { kernel.residual(e, f); });
    });
  }
  return failures;
}

void StressDivergence::jacobian(const StepView& view, Assembler& assembler, double weight) {
  std::string broken;
  for (const SoilBlock& b : soil_->blocks) {
    StressUpdate update(*soil_, b, true);
    const MatrixScatter to = assembler.scatter(b.group);
    for (int first = 0; first < b.elements; first += StressUpdate::batch) {
      const int last = std::min(first + StressUpdate::batch, b.elements);
      update.run(view, first, last);
      if (broken.empty() && update.law_is_broken()) broken = update.failure();
      const PointView D = update.tangent();
      dispatch_pair(b.shape, b.porous(), [&](auto pair) {
        const StressKernel<decltype(pair)::NU, decltype(pair)::NP> kernel(*soil_, b, view);
        Kokkos::parallel_for(
            "tangent", Kokkos::RangePolicy<>(first, last),
            KOKKOS_LAMBDA(int e) { kernel.tangent(e, D, first, to, weight); });
      });
    }
  }
  if (!broken.empty()) throw std::runtime_error(broken);  // all element matrices are there: the ranks stay together
}

std::string StressDivergence::hint(const StepView&) const {
  return of_first_rank(*soil_->space->dofs()->comm(), failure_);
}

void StressDivergence::adopt(const State& evaluated, State& committed) {
  for (const SoilBlock& b : soil_->blocks)
    for (int handle : {b.stress, b.law}) Kokkos::deep_copy(committed.arrays[handle], evaluated.arrays[handle]);
}

}  // namespace mudline
