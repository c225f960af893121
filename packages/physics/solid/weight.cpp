#include "physics/solid/weight.hpp"

#include "framework/loop_term.hpp"
#include "physics/solid/bulk_density.hpp"

namespace mudline {

namespace {

struct Weight : PointLaw {
  static constexpr bool forces = true, rates = false, shape = false;
  BulkDensity density;
  Point gravity, gravity_old;  // [m/s2] at the level, and at the start of the step

  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    const T rho = density(row, at);
    for (int i = 0; i < C::dim; ++i) {
      out.force[i] = rho * -gravity[i];
      out.standing_force[i] = -value(rho) * gravity_old[i];
    }
  }
};

}  // namespace

std::unique_ptr<Term> weight(std::shared_ptr<const Soil> soil, const Gravity& gravity) {
  const Geometry geometry = soil->geometry;
  return loop_term("gravity", Role::force, geometry, [soil, gravity](const StepView& view, auto&& add) {
    const Point now = gravity.at(view.momentum.time), old = gravity.at(view.time_old);
    if (now == Point{}) return;
    for (const SoilBlock& b : soil->blocks)
      add(b, loop_level(view, view.momentum, b),
          Weight{{}, BulkDensity(*soil, b, b, *view.committed, soil->excess), now, old});
  });
}

}  // namespace mudline
