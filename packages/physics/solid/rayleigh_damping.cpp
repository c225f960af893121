#include "physics/solid/rayleigh_damping.hpp"

#include "framework/element_loop.hpp"
#include "physics/soil_points.hpp"

namespace mudline {

namespace {

/// Viscous force and stress of a velocity; all other quantities are those at the start of the step.
struct Viscosity : PointLaw {
  static constexpr bool forces = true, stresses = true, inertia = true, scalars = false;
  double mass_factor, stiffness_factor;
  SoilPoints points;

  template <class C, int S, class T>
  void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    const ElasticModuli m = points.moduli(row);
    const double G = stiffness_factor * m.shear, lambda = stiffness_factor * (m.bulk - 2.0 / 3 * m.shear);
    const double mass = mass_factor * points.density(row);
    const T pressure = lambda * at.divergence();
    for (int i = 0; i < C::dim; ++i) {
      out.force[i] = mass * at.velocity[i];
      for (int j = 0; j < C::dim; ++j) out.stress[i][j] = G * (at.velocity_gradient[i][j] + at.velocity_gradient[j][i]);
      out.stress[i][i] += pressure;
    }
    out.hoop_stress = 2 * G * at.hoop_rate + pressure;
  }
};

}  // namespace

template <class F>
void RayleighDamping::for_each_block(const StepView& view, F&& f) const {
  for (const SoilBlock& b : soil_->blocks) {
    LoopLevel level = loop_level(view, {view.time_old, view.x_old, 0.0}, b);
    level.rate = view.velocity;
    level.displacement.rate = level.displacement.velocity;
    f(b, level, Viscosity{{}, mass_factor_, stiffness_factor_, SoilPoints(*soil_, b, *view.committed)});
  }
}

int RayleighDamping::residual(const StepView& view, const ResidualView& f) {
  int failures = 0;
  if (view.inertia)
    for_each_block(view, [&](const SoilBlock& b, const LoopLevel& level, const auto& law) {
      failures += add_residual(soil_->geometry, b, level, law, f);
    });
  return failures;
}

void RayleighDamping::jacobian(const StepView& view, Assembler& assembler, double weight) {
  if (view.inertia)
    for_each_block(view, [&](const SoilBlock& b, const LoopLevel& level, const auto& law) {
      add_tangent(soil_->geometry, b, level, law, assembler.scatter(b.group), weight);
    });
}

}  // namespace mudline
