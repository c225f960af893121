#include "physics/solid/inertia.hpp"

#include "framework/loop_term.hpp"
#include "physics/solid/bulk_density.hpp"

namespace mudline {

namespace {

struct InertiaForce : PointLaw {
  static constexpr bool forces = true, inertia = true, shape = false;
  BulkDensity density;

  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    const T rho = density(row, at);
    for (int i = 0; i < C::dim; ++i) out.force[i] = rho * at.acceleration[i];
  }
};

}  // namespace

std::unique_ptr<Term> inertia(std::shared_ptr<const Soil> soil) {
  const Geometry geometry = soil->geometry;
  return loop_term("inertia", Role::inertia, geometry, [soil](const StepView& view, auto&& add) {
    if (!view.inertia) return;
    for (const SoilBlock& b : soil->blocks)
      add(b.mass, loop_level(view, view.momentum, b.mass),
          InertiaForce{{}, BulkDensity(*soil, b, b.mass, *view.committed, false)});
  });
}

}  // namespace mudline
