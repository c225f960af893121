#include "physics/solid/rayleigh_damping.hpp"

#include "framework/loop_term.hpp"
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

std::unique_ptr<Term> rayleigh_damping(std::shared_ptr<const Soil> soil, double mass_factor, double stiffness_factor) {
  const Geometry geometry = soil->geometry;
  return loop_term("Rayleigh damping", Role::force, geometry, [=](const StepView& view, auto&& add) {
    if (!view.inertia) return;
    for (const SoilBlock& b : soil->blocks) {
      LoopLevel level = loop_level(view, {view.time_old, view.x_old, 0.0}, b);
      level.rate = view.velocity;
      level.displacement.rate = level.displacement.velocity;
      add(b, level, Viscosity{{}, mass_factor, stiffness_factor, SoilPoints(*soil, b, *view.committed)});
    }
  });
}

}  // namespace mudline
