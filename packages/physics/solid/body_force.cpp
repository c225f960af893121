#include "physics/solid/body_force.hpp"

#include <cmath>

#include "framework/loop_term.hpp"
#include "physics/mixture.hpp"

namespace mudline {

namespace {

/// Density of the soil at the points of `at`, which has the elements of the soil's block b.
struct BulkDensity {
  ByMaterial<Mixture> mixtures;
  PointView void_ratio;
  int points, soil_points;  // number of points per element: in `at`, and of those with a void ratio
  bool submerged;           // less the uplift of the water, alpha rho_f

  BulkDensity(const Soil& soil, const SoilBlock& b, const FieldBlock& at, const State& state, bool submerged_)
      : mixtures(mixtures_of(soil, b, state)),
        void_ratio(state.arrays[b.void_ratio]),
        points(at.points),
        soil_points(b.points),
        submerged(submerged_) {}

  /// Density of the point. Where the points are not those of the soil, it is the density of the element: by its mean
  /// void ratio or, with several materials, the mean over its points.
  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION T operator()(int row, const PointFields<C, S, T>& at) const {
    if (points == soil_points) return density(mixtures(row), void_ratio(row, 0), at);
    const int first = row / points * soil_points;
    double ratio = 0;
    bool one = true;
    for (int q = 0; q < soil_points; ++q) {
      ratio += void_ratio(first + q, 0);
      one = one && mixtures.which(first + q, 0) == mixtures.which(first, 0);
    }
    if (one) return density(mixtures(first), ratio / soil_points, at);
    T sum = 0.0;
    for (int q = 0; q < soil_points; ++q) sum += density(mixtures(first + q), void_ratio(first + q, 0), at);
    return sum * (1.0 / soil_points);
  }

 private:
  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION T density(const Mixture& mixture, double ratio, const PointFields<C, S, T>& at) const {
    return mixture.density(mixture.porosity(ratio, at), at) - (submerged ? mixture.alpha * mixture.fluid_density : 0.0);
  }
};

struct InertiaForce : PointLaw {
  static constexpr bool forces = true, inertia = true;
  BulkDensity density;

  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    const T rho = density(row, at);
    for (int i = 0; i < C::dim; ++i) out.force[i] = rho * at.acceleration[i];
  }
};

struct Weight : PointLaw {
  static constexpr bool forces = true, rates = false;
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

Point Gravity::up(int dimension) const {
  Point result{};
  const double size = std::hypot(vector[0], vector[1], vector[2]);
  if (size == 0) result[dimension - 1] = 1;
  if (size > 0)
    for (int i = 0; i < 3; ++i) result[i] = -vector[i] / size;
  return result;
}

std::unique_ptr<Term> inertia(std::shared_ptr<const Soil> soil) {
  const Geometry geometry = soil->geometry;
  return loop_term("inertia", Role::inertia, geometry, [soil](const StepView& view, auto&& add) {
    if (!view.inertia) return;
    for (const SoilBlock& b : soil->blocks)
      add(b.mass, loop_level(view, view.momentum, b.mass),
          InertiaForce{{}, BulkDensity(*soil, b, b.mass, *view.committed, false)});
  });
}

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
