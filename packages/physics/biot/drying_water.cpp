#include "physics/biot/drying_water.hpp"

#include "framework/medium.hpp"
#include "physics/biot/darcy.hpp"

namespace mudline {

namespace {

/// What is stored is a difference of contents, so that no water is lost however fast they change in a step.
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

std::unique_ptr<Term> drying_water(std::shared_ptr<const Soil> soil) {
  const Geometry geometry = soil->geometry;
  return loop_term("drying water", Role::balance, geometry, [soil](const StepView& view, auto&& add) {
    if (!view.flow) return;
    for (const SoilBlock& b : soil->blocks) {
      if (!b.dries) continue;
      const DryingWater medium{{}, Darcy(*soil, b, view), view.dt};
      add(b, end_level(view, b), stored_law(medium));
      add(b, loop_level(view, view.balance, b), flow_law(medium));
    }
  });
}

}  // namespace mudline
