#include "physics/biot/fluid_mass.hpp"

#include "framework/medium.hpp"
#include "physics/biot/darcy.hpp"

namespace mudline {

namespace {

/// Water in the pores, with its acceleration in Darcy's law or without.
template <bool FluidAcceleration>
struct PoreWater : Medium {
  enum { pore_pressure, scalars };
  static constexpr bool rates = true, inertia = FluidAcceleration;
  Darcy darcy;

  template <class C, class T>
  KOKKOS_INLINE_FUNCTION void flows(int row, const PointFields<C, scalars, T>& at,
                                    PointBalance<C, scalars, T>& out) const {
    const T n = darcy.porosity(row, at), mobility = darcy.mobility(row, n);
    const Mixture& mixture = darcy.mixture(row);
    const double density = mixture.fluid_density, weight = density - darcy.lift;
    out.storage[pore_pressure] = mixture.alpha * at.divergence() + mixture.storage(n) * at.rate[pore_pressure];
    T drive[C::dim];
    for (int i = 0; i < C::dim; ++i) {
      drive[i] = at.gradient[pore_pressure][i] - weight * darcy.gravity[i];
      if constexpr (FluidAcceleration) drive[i] += density * at.acceleration[i];
    }
    darcy.minus_discharge(row, mobility, drive, out.flux[pore_pressure]);
  }
};

}  // namespace

std::unique_ptr<Term> fluid_mass(std::shared_ptr<const Soil> soil, bool fluid_acceleration) {
  const Geometry geometry = soil->geometry;
  return loop_term("fluid mass", Role::balance, geometry, [soil, fluid_acceleration](const StepView& view, auto&& add) {
    if (!view.flow) return;
    for (const SoilBlock& b : soil->blocks) {
      if (b.dries) continue;
      const Darcy darcy(*soil, b, view);
      const LoopLevel level = loop_level(view, view.balance, b);
      if (fluid_acceleration && view.inertia) {
        add(b, level, flow_law(PoreWater<true>{{}, darcy}));
      } else {
        add(b, level, flow_law(PoreWater<false>{{}, darcy}));
      }
    }
  });
}

}  // namespace mudline
