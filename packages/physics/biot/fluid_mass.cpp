#include "physics/biot/fluid_mass.hpp"

#include "framework/loop_term.hpp"
#include "physics/biot/darcy.hpp"

namespace mudline {

namespace {

template <bool FluidAcceleration>
struct DarcyFlow : PointLaw {
  static constexpr int fields = 1;
  static constexpr bool storages = true, fluxes = true, gradients = true, inertia = FluidAcceleration;
  Darcy darcy;

  template <class C, int S, class T>
  void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    const T n = darcy.porosity(row, at), mobility = darcy.mobility(row, n);
    const Mixture& mixture = darcy.mixture(row);
    const double density = mixture.fluid_density, weight = density - darcy.lift;
    out.storage[0] = mixture.alpha * at.divergence() + mixture.storage(n) * at.rate[0];
    for (int i = 0; i < C::dim; ++i) {
      T drive = at.gradient[0][i] - weight * darcy.gravity[i];
      if constexpr (FluidAcceleration) drive += density * at.acceleration[i];
      out.flux[0][i] = mobility * drive;
    }
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
      if (fluid_acceleration && view.inertia)
        add(b, level, DarcyFlow<true>{{}, darcy});
      else
        add(b, level, DarcyFlow<false>{{}, darcy});
    }
  });
}

}  // namespace mudline
