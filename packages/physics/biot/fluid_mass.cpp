#include "physics/biot/fluid_mass.hpp"

#include "framework/element_loop.hpp"
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

template <class F>
void FluidMass::for_each_block(const StepView& view, F&& f) const {
  for (const SoilBlock& b : soil_->blocks) {
    const Darcy darcy(*soil_, b, view);
    if (fluid_acceleration_ && view.inertia)
      f(b, DarcyFlow<true>{{}, darcy});
    else
      f(b, DarcyFlow<false>{{}, darcy});
  }
}

int FluidMass::residual(const StepView& view, const ResidualView& f) {
  if (!view.flow) return 0;
  int failures = 0;
  for_each_block(view, [&](const SoilBlock& b, const auto& law) {
    failures += add_residual(soil_->geometry, b, loop_level(view, view.balance, b), law, f);
  });
  return failures;
}

void FluidMass::jacobian(const StepView& view, Assembler& assembler, double weight) {
  if (!view.flow) return;
  for_each_block(view, [&](const SoilBlock& b, const auto& law) {
    add_tangent(soil_->geometry, b, loop_level(view, view.balance, b), law, assembler.scatter(b.group), weight);
  });
}

}  // namespace mudline
