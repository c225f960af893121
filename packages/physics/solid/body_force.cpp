#include "physics/solid/body_force.hpp"

#include "framework/element_loop.hpp"
#include "physics/mixture.hpp"

namespace mudline {

namespace {

/// rho b with b = a (Inertia) or b = -g; with pore pressures in excess of water at rest the water's lift is taken off.
template <bool Inertia>
struct Weight : PointLaw {
  static constexpr bool forces = true, inertia = Inertia, rates = Inertia;
  Mixture mixture;
  double lift, gravity[2], gravity_old[2];
  PointView void_ratio;

  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    const T rho = mixture.density(mixture.porosity(void_ratio(row, 0), at), at) - lift;
    for (int i = 0; i < C::dim; ++i) {
      if constexpr (Inertia)
        out.force[i] = rho * at.acceleration[i];
      else
        out.force[i] = rho * -gravity[i];
      out.standing_force[i] = Inertia ? 0.0 : -value(rho) * gravity_old[i];
    }
  }
};

}  // namespace

template <class F>
void BodyForce::for_each_block(const StepView& view, F&& f) const {
  const auto now = gravity_.at(view.momentum.time), old = gravity_.at(view.time_old);
  for (const SoilBlock& b : soil_->blocks) {
    const auto apply = [&](auto inertia) {
      constexpr bool accelerates = decltype(inertia)::value;
      f(b, Weight<accelerates>{{},
                               Mixture(*soil_, b),
                               accelerates ? 0.0 : soil_->uplift(*b.material),
                               {now[0], now[1]},
                               {old[0], old[1]},
                               view.committed->arrays[b.void_ratio]});
    };
    if (kind_ == Kind::inertia)
      apply(std::true_type{});
    else
      apply(std::false_type{});
  }
}

bool BodyForce::active(const StepView& view) const {
  if (kind_ == Kind::inertia) return view.inertia;
  const auto g = gravity_.at(view.momentum.time);
  return g[0] != 0 || g[1] != 0;
}

int BodyForce::residual(const StepView& view, const ResidualView& f) {
  if (!active(view)) return 0;
  int failures = 0;
  for_each_block(view, [&](const SoilBlock& b, const auto& law) {
    failures += add_residual(soil_->geometry, b, loop_level(view, view.momentum, b), law, f);
  });
  return failures;
}

void BodyForce::jacobian(const StepView& view, Assembler& assembler, double weight) {
  if (!active(view)) return;
  for_each_block(view, [&](const SoilBlock& b, const auto& law) {
    add_tangent(soil_->geometry, b, loop_level(view, view.momentum, b), law, assembler.scatter(b.group), weight);
  });
}

}  // namespace mudline
