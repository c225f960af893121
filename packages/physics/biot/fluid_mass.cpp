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

/// Water that would fill the pores of soil which dries under suction; pore_air() takes away what is missing. What is
/// stored is a difference of contents, so that no water is lost however fast they change in a step.
struct DryingWater : Medium {
  enum { pore_pressure, scalars };
  static constexpr bool cancels = true;
  Darcy darcy;
  double dt;

  template <class C, class T>
  KOKKOS_INLINE_FUNCTION void stored(int row, const PointFields<C, scalars, T>& at,
                                     PointBalance<C, scalars, T>& out) const {
    const Mixture& mixture = darcy.mixture(row);
    const double e = darcy.void_ratio(row, 0), before = value(at.value[pore_pressure] - at.change[pore_pressure]),
                 content = e / (1 + e) * (1 + before * mixture.fluid_compliance);
    const T now = darcy.porosity(row, at) * (1.0 + at.value[pore_pressure] * mixture.fluid_compliance),
            old = content / at.volume_ratio;
    out.storage[pore_pressure] = (now - old) * (1 / dt);
    out.cancelled[pore_pressure] = (value(now) + value(old)) / dt;
  }
  template <class C, class T>
  KOKKOS_INLINE_FUNCTION void flows(int row, const PointFields<C, scalars, T>& at,
                                    PointBalance<C, scalars, T>& out) const {
    darcy.minus_discharge(row, at, out.flux[pore_pressure]);
  }
};

}  // namespace

std::unique_ptr<Term> fluid_mass(std::shared_ptr<const Soil> soil, bool fluid_acceleration) {
  const Geometry geometry = soil->geometry;
  return loop_term("fluid mass", Role::balance, geometry, [soil, fluid_acceleration](const StepView& view, auto&& add) {
    if (!view.flow) return;
    for (const SoilBlock& b : soil->blocks) {
      const Darcy darcy(*soil, b, view);
      const LoopLevel level = loop_level(view, view.balance, b);
      if (b.dries) {
        const DryingWater medium{{}, darcy, view.dt};
        add(b, end_level(view, b), stored_law(medium));
        add(b, level, flow_law(medium));
      } else if (fluid_acceleration && view.inertia) {
        add(b, level, flow_law(PoreWater<true>{{}, darcy}));
      } else {
        add(b, level, flow_law(PoreWater<false>{{}, darcy}));
      }
    }
  });
}

}  // namespace mudline
