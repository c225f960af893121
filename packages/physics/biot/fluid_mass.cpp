#include "physics/biot/fluid_mass.hpp"

#include "framework/element_loop.hpp"
#include "physics/mixture.hpp"

namespace mudline {

namespace {

template <bool FluidAcceleration>
struct DarcyFlow : PointLaw {
  static constexpr bool storages = true, fluxes = true, gradients = true, inertia = FluidAcceleration;
  Mixture mixture;
  const Permeability* permeability;
  double unit_weight, gravity[2];
  PointView void_ratio;

  template <class C, int S, class T>
  void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    const T n = mixture.porosity(void_ratio(row, 0), at);
    const T e = n / (1.0 - n);
    const Permeability::Value k = permeability->conductivity(value(e), void_ratio(row, 1));
    const T mobility = chain(e, k.k, k.dk_de) * (1 / unit_weight);
    out.storage[0] = mixture.alpha * at.divergence() + mixture.storage(n) * at.rate[0];
    for (int i = 0; i < C::dim; ++i) {
      T drive = at.gradient[0][i] - mixture.fluid_density * gravity[i];
      if constexpr (FluidAcceleration) drive += mixture.fluid_density * at.acceleration[i];
      out.flux[0][i] = mobility * drive;
    }
  }
};

}  // namespace

template <class F>
void FluidMass::for_each_block(const StepView& view, F&& f) const {
  const auto g = gravity_.at(view.balance.time);
  for (const SoilBlock& b : soil_->blocks) {
    const auto apply = [&](auto acceleration) {
      f(b, DarcyFlow<decltype(acceleration)::value>{{},
                                                    Mixture(*soil_, b),
                                                    b.material->permeability.get(),
                                                    b.material->fluid->unit_weight(),
                                                    {g[0], g[1]},
                                                    view.committed->arrays[b.void_ratio]});
    };
    if (fluid_acceleration_ && view.inertia)
      apply(std::true_type{});
    else
      apply(std::false_type{});
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
