#include "physics/solid/body_force.hpp"

#include "physics/porosity.hpp"

namespace mudline {

namespace {

template <int NU, int NP>
struct BodyForceKernel {
  bool axisymmetric, inertia;
  int points;
  Mixture mixture;
  double lift, gravity[2], gravity_old[2], acceleration_slope, geometry_slope, pressure_slope;
  Kokkos::View<double*> weights;
  Kokkos::View<double**, Kokkos::LayoutRight> N, Np;
  Kokkos::View<double***, Kokkos::LayoutRight> dN;
  Kokkos::View<int**, Kokkos::LayoutRight> nodes;
  ElementDofs dofs;
  PointView void_ratio;
  ConstCoordinateView x_old, x_alpha;
  ConstNodalView acceleration, value, value_old;

  BodyForceKernel(const Soil& soil, const SoilBlock& b, const StepView& view, bool is_inertia, const Gravity& g)
      : axisymmetric(soil.axisymmetric),
        inertia(is_inertia),
        points(b.points),
        mixture(*b.material),
        lift(is_inertia ? 0.0 : soil.uplift(*b.material)),
        gravity{g.at(view.momentum.time)[0], g.at(view.momentum.time)[1]},
        gravity_old{g.at(view.time_old)[0], g.at(view.time_old)[1]},
        acceleration_slope(view.sensitivity[soil.displacement].acceleration),
        geometry_slope(view.momentum.geometry_weight),
        pressure_slope(soil.pressure >= 0 ? view.sensitivity[soil.pressure].value : 0.0),
        weights(b.u.weights),
        N(b.u.N),
        Np(b.p.N),
        dN(b.u.dN),
        nodes(b.nodes),
        dofs(b.dofs),
        void_ratio(view.committed->arrays[b.void_ratio]),
        x_old(view.x_old),
        x_alpha(view.momentum.x),
        acceleration(view.acceleration),
        value(view.value),
        value_old(view.value_old) {}

  /// Porosity and body acceleration b at a point; false where the configuration is inverted.
  KOKKOS_INLINE_FUNCTION bool point(int e, int q, const PointGeometry<NU>& at, const PointGeometry<NU>& old, double& n,
                                    double (&b)[2]) const {
    b[0] = -gravity[0];
    b[1] = -gravity[1];
    if (inertia) {
      b[0] = b[1] = 0;
      for (int a = 0; a < NU; ++a) {
        b[0] += N(q, a) * acceleration(dofs(e, 2 * a));
        b[1] += N(q, a) * acceleration(dofs(e, 2 * a + 1));
      }
    }
    if (!at.ok) return false;
    double dp = 0;
    if (mixture.grain_compliance > 0)
      for (int c = 0; c < NP; ++c) dp += Np(q, c) * (value(dofs(e, 2 * NU + c)) - value_old(dofs(e, 2 * NU + c)));
    const double e_old = void_ratio(e * points + q, 0);
    n = mixture.porosity(e_old / (1 + e_old), at.det * at.r / (old.det * old.r), dp);
    return true;
  }

  /// Inertia acts in the step as a whole, of the weight only its change.
  KOKKOS_INLINE_FUNCTION int residual(int e, const ResidualView& f) const {
    double xo[NU][2], x[NU][2], r[2 * NU] = {0}, change[2 * NU] = {0};
    gather<NU>(nodes, e, x_old, xo);
    gather<NU>(nodes, e, x_alpha, x);
    for (int q = 0; q < points; ++q) {
      PointGeometry<NU> at, old;
      at.compute(x, &dN(q, 0, 0), &N(q, 0), axisymmetric);
      old.compute(xo, &dN(q, 0, 0), &N(q, 0), axisymmetric);
      double n, b[2];
      if (!point(e, q, at, old, n, b)) return 1;
      const double mass = (mixture.density(n) - lift) * at.volume(weights(q));
      for (int a = 0; a < NU; ++a) {
        for (int i = 0; i < 2; ++i) {
          r[2 * a + i] += mass * b[i] * N(q, a);
          change[2 * a + i] += mass * (inertia ? b[i] : b[i] + gravity_old[i]) * N(q, a);
        }
      }
    }
    scatter_vector<2 * NU>(dofs, e, 0, r, change, f);
    return 0;
  }

  KOKKOS_INLINE_FUNCTION void tangent(int e, const MatrixScatter& to, double weight) const {
    double xo[NU][2], x[NU][2], k[2 * NU][2 * NU] = {{0}}, kp[2 * NU][NP > 0 ? NP : 1] = {{0}};
    gather<NU>(nodes, e, x_old, xo);
    gather<NU>(nodes, e, x_alpha, x);
    for (int q = 0; q < points; ++q) {
      PointGeometry<NU> at, old;
      at.compute(x, &dN(q, 0, 0), &N(q, 0), axisymmetric);
      old.compute(xo, &dN(q, 0, 0), &N(q, 0), axisymmetric);
      double n, b[2];
      if (!point(e, q, at, old, n, b)) return;
      const double dv = at.volume(weights(q)), rho = mixture.density(n) - lift;
      const double over_r = axisymmetric ? 1 / at.r : 0.0;
      const double drho = (mixture.fluid_density - mixture.grain_density) * mixture.porosity_slope(n);
      const double mass_slope = inertia ? rho * dv * acceleration_slope : 0.0;
      for (int c = 0; c < NU; ++c) {
        // d(rho dv) = (rho + d rho/d ln J) div(du) dv
        const double stretch = (rho + drho) * dv * geometry_slope;
        const double by[2] = {stretch * (at.g[c][0] + N(q, c) * over_r), stretch * at.g[c][1]};
        for (int a = 0; a < NU; ++a)
          for (int i = 0; i < 2; ++i) {
            k[2 * a + i][2 * c + i] += mass_slope * N(q, a) * N(q, c);
            for (int j = 0; j < 2; ++j) k[2 * a + i][2 * c + j] += N(q, a) * b[i] * by[j];
          }
      }
      if (mixture.grain_compliance > 0)
        for (int a = 0; a < NU; ++a)
          for (int i = 0; i < 2; ++i)
            for (int c = 0; c < NP; ++c)
              kp[2 * a + i][c] += N(q, a) * b[i] * drho * mixture.grain_compliance * pressure_slope * Np(q, c) * dv;
    }
    scatter_matrix<2 * NU, 2 * NU>(to, e, 0, 0, k, weight);
    if constexpr (NP > 0)
      if (mixture.grain_compliance > 0) scatter_matrix<2 * NU, NP>(to, e, 0, 2 * NU, kp, weight);
  }
};

}  // namespace

bool BodyForce::active(const StepView& view) const {
  if (kind_ == Kind::inertia) return view.inertia;
  const auto g = gravity_.at(view.momentum.time);
  return g[0] != 0 || g[1] != 0;
}

int BodyForce::residual(const StepView& view, const ResidualView& f) {
  if (!active(view)) return 0;
  int failures = 0;
  for (const SoilBlock& b : soil_->blocks)
    failures += dispatch_pair(b.shape, b.porous(), [&](auto pair) {
      const BodyForceKernel<decltype(pair)::NU, decltype(pair)::NP> kernel(*soil_, b, view, kind_ == Kind::inertia,
                                                                           gravity_);
      int failed = 0;
      Kokkos::parallel_reduce(
          "body force", Kokkos::RangePolicy<>(0, b.elements),
          KOKKOS_LAMBDA(int e, int& sum) { sum += kernel.residual(e, f); }, failed);
      return failed;
    });
  return failures;
}

void BodyForce::jacobian(const StepView& view, Assembler& assembler, double weight) {
  if (!active(view)) return;
  for (const SoilBlock& b : soil_->blocks) {
    const MatrixScatter to = assembler.scatter(b.group);
    dispatch_pair(b.shape, b.porous(), [&](auto pair) {
      const BodyForceKernel<decltype(pair)::NU, decltype(pair)::NP> kernel(*soil_, b, view, kind_ == Kind::inertia,
                                                                           gravity_);
      Kokkos::parallel_for(
          "body force tangent", Kokkos::RangePolicy<>(0, b.elements),
          KOKKOS_LAMBDA(int e) { kernel.tangent(e, to, weight); });
    });
  }
}

}  // namespace mudline
