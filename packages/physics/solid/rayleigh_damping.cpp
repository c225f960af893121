#include "physics/solid/rayleigh_damping.hpp"

#include "framework/loop_term.hpp"
#include "physics/soil_points.hpp"

namespace mudline {

namespace {

/// Viscous force and stress of a velocity; all other quantities are those at the start of the step.
struct Viscosity : PointLaw {
  static constexpr bool forces = true, stresses = true, inertia = true, scalars = false;
  PointView viscosities;  // (point; of shear and of volume [Pa s], of motion against the frame [kg/(m3 s)])

  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    const double G = viscosities(row, 0), lambda = viscosities(row, 1), mass = viscosities(row, 2);
    const T pressure = lambda * at.divergence();
    for (int i = 0; i < C::dim; ++i) {
      out.force[i] = mass * at.velocity[i];
      for (int j = 0; j < C::dim; ++j) out.stress[i][j] = G * (at.velocity_gradient[i][j] + at.velocity_gradient[j][i]);
      out.stress[i][i] += pressure;
    }
    out.hoop_stress = 2 * G * at.hoop_rate + pressure;
  }
};

/// The viscosities at the points of a block, from the stiffness and the density of the soil there.
PointView viscosities(const Soil& soil, const SoilBlock& b, const State& state, double mass_factor,
                      double stiffness_factor) {
  const SoilPoints points(soil, b, state);
  PointView result("viscosities", static_cast<std::size_t>(b.elements) * b.points, 3);
  for (int row = 0; row < b.elements * b.points; ++row) {
    const ElasticModuli m = points.moduli(row);
    result(row, 0) = stiffness_factor * m.shear;
    result(row, 1) = stiffness_factor * (m.bulk - 2.0 / 3 * m.shear);
    result(row, 2) = mass_factor * points.density(row);
  }
  return result;
}

}  // namespace

std::unique_ptr<Term> rayleigh_damping(std::shared_ptr<const Soil> soil, double mass_factor, double stiffness_factor) {
  const Geometry geometry = soil->geometry;
  return loop_term("Rayleigh damping", Role::force, geometry, [=](const StepView& view, auto&& add) {
    if (!view.inertia) return;
    for (const SoilBlock& b : soil->blocks) {
      LoopLevel level = loop_level(view, {view.time_old, view.x_old, 0.0}, b);
      level.rate = view.velocity;
      level.displacement.rate = level.displacement.velocity;
      add(b, level, Viscosity{{}, viscosities(*soil, b, *view.committed, mass_factor, stiffness_factor)});
    }
  });
}

}  // namespace mudline
