#include "physics/biot/fluid_mass.hpp"

#include "physics/porosity.hpp"

namespace mudline {

namespace {

/// Everything at one quadrature point that residual and tangent share.
struct FluidPoint {
  double n, storage, mobility, mobility_slope;  // kappa [m2/(Pa s)], d kappa / d n
  double divergence, velocity_gradient[2][2], radial_velocity;
  double pdot, flow[2];  // grad p - rho_f g + rho_f a [Pa/m]
  double grad_p[2];
};

template <int NU, int NP>
struct FluidMassKernel {
  bool axisymmetric, accelerating;
  int points;
  Mixture mixture;
  const Permeability* permeability;
  double unit_weight, gravity[2];
  Sensitivity u, p;
  double geometry_slope;
  Kokkos::View<double*> weights;
  Kokkos::View<double**, Kokkos::LayoutRight> N, Np;
  Kokkos::View<double***, Kokkos::LayoutRight> dN, dNp;
  Kokkos::View<int**, Kokkos::LayoutRight> nodes;
  ElementDofs dofs;
  PointView void_ratio;
  ConstCoordinateView x_old, x_alpha;
  ConstNodalView value, value_old, rate, acceleration;

  FluidMassKernel(const Soil& soil, const SoilBlock& b, const StepView& view, std::array<double, 2> g,
                  bool fluid_acceleration)
      : axisymmetric(soil.axisymmetric),
        accelerating(fluid_acceleration && view.inertia),
        points(b.points),
        mixture(*b.material),
        permeability(b.material->permeability.get()),
        unit_weight(b.material->fluid->unit_weight()),
        gravity{g[0], g[1]},
        u(view.sensitivity[soil.displacement]),
        p(view.sensitivity[soil.pressure]),
        geometry_slope(view.balance.geometry_weight),
        weights(b.u.weights),
        N(b.u.N),
        Np(b.p.N),
        dN(b.u.dN),
        dNp(b.p.dN),
        nodes(b.nodes),
        dofs(b.dofs),
        void_ratio(view.committed->arrays[b.void_ratio]),
        x_old(view.x_old),
        x_alpha(view.balance.x),
        value(view.value),
        value_old(view.value_old),
        rate(view.rate),
        acceleration(view.acceleration) {}

  /// Pressure gradients on the element's own (quadratic) map: the linear shapes' reference gradients pulled by its
  /// Jacobian.
  KOKKOS_INLINE_FUNCTION void pressure_gradients(int q, const double (&x)[NU][2], double (&gp)[NP][2]) const {
    double j[2][2] = {{0, 0}, {0, 0}};
    for (int a = 0; a < NU; ++a)
      for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 2; ++k) j[i][k] += x[a][i] * dN(q, a, k);
    const double inverse = 1 / (j[0][0] * j[1][1] - j[0][1] * j[1][0]);
    for (int c = 0; c < NP; ++c) {
      gp[c][0] = (j[1][1] * dNp(q, c, 0) - j[1][0] * dNp(q, c, 1)) * inverse;
      gp[c][1] = (-j[0][1] * dNp(q, c, 0) + j[0][0] * dNp(q, c, 1)) * inverse;
    }
  }

  KOKKOS_INLINE_FUNCTION bool point(int e, int q, const double (&xo)[NU][2], const PointGeometry<NU>& at,
                                    const double (&gp)[NP][2], FluidPoint& s) const {
    PointGeometry<NU> old;
    old.compute(xo, &dN(q, 0, 0), &N(q, 0), axisymmetric);
    if (!at.ok || !old.ok) return false;
    double dp = 0;
    s.pdot = 0;
    s.grad_p[0] = s.grad_p[1] = 0;
    for (int c = 0; c < NP; ++c) {
      const int dof = dofs(e, 2 * NU + c);
      dp += Np(q, c) * (value(dof) - value_old(dof));
      s.pdot += Np(q, c) * rate(dof);
      s.grad_p[0] += gp[c][0] * value(dof);
      s.grad_p[1] += gp[c][1] * value(dof);
    }
    double a[2] = {0, 0};
    s.radial_velocity = 0;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) s.velocity_gradient[i][j] = 0;
    for (int b = 0; b < NU; ++b)
      for (int i = 0; i < 2; ++i) {
        const int dof = dofs(e, 2 * b + i);
        if (accelerating) a[i] += N(q, b) * acceleration(dof);
        for (int j = 0; j < 2; ++j) s.velocity_gradient[i][j] += rate(dof) * at.g[b][j];
        if (i == 0) s.radial_velocity += N(q, b) * rate(dof);
      }
    s.divergence = s.velocity_gradient[0][0] + s.velocity_gradient[1][1];
    if (axisymmetric) s.divergence += s.radial_velocity / at.r;
    const int row = e * points + q;
    const double e_old = void_ratio(row, 0);
    s.n = mixture.porosity(e_old / (1 + e_old), at.det * at.r / (old.det * old.r), dp);
    s.storage = mixture.storage(s.n);
    const double now = s.n / (1 - s.n);
    const Permeability::Value k = permeability->conductivity(now, void_ratio(row, 1));
    s.mobility = k.k / unit_weight;
    s.mobility_slope = k.dk_de / unit_weight / ((1 - s.n) * (1 - s.n));
    for (int i = 0; i < 2; ++i) s.flow[i] = s.grad_p[i] - mixture.fluid_density * (gravity[i] - a[i]);
    return true;
  }

  /// Both storage and flow act in the step, each by itself: in consolidation they cancel.
  int residual(int e, const ResidualView& f) const {
    double xo[NU][2], x[NU][2], stored[NP] = {0}, flown[NP] = {0}, r[NP], acting[NP];
    gather<NU>(nodes, e, x_old, xo);
    gather<NU>(nodes, e, x_alpha, x);
    for (int q = 0; q < points; ++q) {
      PointGeometry<NU> at;
      at.compute(x, &dN(q, 0, 0), &N(q, 0), axisymmetric);
      if (!at.ok) return 1;
      double gp[NP][2];
      pressure_gradients(q, x, gp);
      FluidPoint s;
      if (!point(e, q, xo, at, gp, s)) return 1;
      const double dv = at.volume(weights(q));
      const double storage = mixture.alpha * s.divergence + s.storage * s.pdot;
      for (int c = 0; c < NP; ++c) {
        stored[c] += dv * Np(q, c) * storage;
        flown[c] += dv * s.mobility * (gp[c][0] * s.flow[0] + gp[c][1] * s.flow[1]);
      }
    }
    for (int c = 0; c < NP; ++c) {
      r[c] = stored[c] + flown[c];
      acting[c] = std::abs(stored[c]) + std::abs(flown[c]);
    }
    scatter_vector<NP>(dofs, e, 2 * NU, r, acting, f);
    return 0;
  }

  void tangent_point(int q, const PointGeometry<NU>& at, const double (&gp)[NP][2], const FluidPoint& s,
                     double (&ku)[NP][2 * NU], double (&kp)[NP][NP]) const {
    const double dv = at.volume(weights(q)), over_r = axisymmetric ? 1 / at.r : 0.0;
    const double stored = mixture.alpha * s.divergence + s.storage * s.pdot;
    const double slope = mixture.porosity_slope(s.n);  // dn / d ln J
    const double storage_slope = s.pdot * (mixture.fluid_compliance - mixture.grain_compliance) * slope;
    double conduct[NP];
    for (int c = 0; c < NP; ++c) conduct[c] = gp[c][0] * s.flow[0] + gp[c][1] * s.flow[1];
    for (int b = 0; b < NU; ++b) {
      const double gq = at.g[b][0] * s.flow[0] + at.g[b][1] * s.flow[1];
      for (int j = 0; j < 2; ++j) {
        const double D = at.g[b][j] + (j == 0 ? N(q, b) * over_r : 0.0);  // div of the variation
        double d_div = -(s.velocity_gradient[0][j] * at.g[b][0] + s.velocity_gradient[1][j] * at.g[b][1]);
        if (j == 0) d_div -= s.radial_velocity * over_r * N(q, b) * over_r;
        const double volume =
            mixture.alpha * (u.rate * D + geometry_slope * d_div) + geometry_slope * D * (stored + storage_slope);
        const double flow_scale = geometry_slope * D * (s.mobility + s.mobility_slope * slope);
        const double inertia = accelerating ? mixture.fluid_density * u.acceleration * N(q, b) : 0.0;
        for (int c = 0; c < NP; ++c) {
          const double gg = gp[c][0] * at.g[b][0] + gp[c][1] * at.g[b][1];
          ku[c][2 * b + j] +=
              dv * (Np(q, c) * volume + conduct[c] * flow_scale +
                    s.mobility * (gp[c][j] * (inertia - geometry_slope * gq) - geometry_slope * gg * s.grad_p[j]));
        }
      }
    }
    const double by_pressure = slope * mixture.grain_compliance * p.value;  // dn / dp_d per Np
    for (int c = 0; c < NP; ++c)
      for (int d = 0; d < NP; ++d) {
        kp[c][d] += dv * (s.storage * p.rate * Np(q, c) * Np(q, d) +
                          s.mobility * p.value * (gp[c][0] * gp[d][0] + gp[c][1] * gp[d][1]));
        if (by_pressure != 0)
          kp[c][d] += dv * Np(q, d) * by_pressure *
                      (Np(q, c) * s.pdot * (mixture.fluid_compliance - mixture.grain_compliance) +
                       s.mobility_slope * conduct[c]);
      }
  }

  void tangent(int e, const MatrixScatter& to, double weight) const {
    double xo[NU][2], x[NU][2], ku[NP][2 * NU] = {{0}}, kp[NP][NP] = {{0}};
    gather<NU>(nodes, e, x_old, xo);
    gather<NU>(nodes, e, x_alpha, x);
    for (int q = 0; q < points; ++q) {
      PointGeometry<NU> at;
      at.compute(x, &dN(q, 0, 0), &N(q, 0), axisymmetric);
      if (!at.ok) return;
      double gp[NP][2];
      pressure_gradients(q, x, gp);
      FluidPoint s;
      if (!point(e, q, xo, at, gp, s)) return;
      tangent_point(q, at, gp, s, ku, kp);
    }
    scatter_matrix<NP, 2 * NU>(to, e, 2 * NU, 0, ku, weight);
    scatter_matrix<NP, NP>(to, e, 2 * NU, 2 * NU, kp, weight);
  }
};

/// Calls f(kernel) for the block's pair; soil without pore fluid has no fluid mass.
template <class F>
int with_kernel(const Soil& soil, const SoilBlock& b, const StepView& view, std::array<double, 2> g, bool acceleration,
                F&& f) {
  return dispatch_pair(b.shape, true, [&](auto pair) {
    using Pair = decltype(pair);
    if constexpr (Pair::NP > 0)
      return f(FluidMassKernel<Pair::NU, Pair::NP>(soil, b, view, g, acceleration));
    else
      return 0;
  });
}

}  // namespace

int FluidMass::residual(const StepView& view, const ResidualView& f) {
  if (!view.flow) return 0;
  int failures = 0;
  for (const SoilBlock& b : soil_->blocks)
    failures +=
        with_kernel(*soil_, b, view, gravity_.at(view.balance.time), fluid_acceleration_, [&](const auto& kernel) {
          int failed = 0;
          for (int e = 0; e < b.elements; ++e) failed += kernel.residual(e, f);
          return failed;
        });
  return failures;
}

void FluidMass::jacobian(const StepView& view, Assembler& assembler, double weight) {
  if (!view.flow) return;
  for (const SoilBlock& b : soil_->blocks) {
    const MatrixScatter to = assembler.scatter(b.group);
    with_kernel(*soil_, b, view, gravity_.at(view.balance.time), fluid_acceleration_, [&](const auto& kernel) {
      for (int e = 0; e < b.elements; ++e) kernel.tangent(e, to, weight);
      return 0;
    });
  }
}

}  // namespace mudline
