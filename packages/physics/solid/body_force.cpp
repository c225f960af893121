#include "physics/solid/body_force.hpp"

#include <cmath>

#include "framework/element_loop.hpp"
#include "physics/mixture.hpp"

namespace mudline {

namespace {

/// rho b with b = a (Inertia) or b = -g; with pore pressures in excess of water at rest the water's lift, alpha rho_f,
/// is taken off.
template <bool Inertia>
struct Weight : PointLaw {
  static constexpr bool forces = true, inertia = Inertia, rates = Inertia;
  Mixtures mixtures;
  bool lifted;
  double gravity[3], gravity_old[3];
  PointView void_ratio;
  int points, soil_points;  // of an element here, and where its void ratio is known

  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    const T rho = density_at(row, at);
    for (int i = 0; i < C::dim; ++i) {
      if constexpr (Inertia)
        out.force[i] = rho * at.acceleration[i];
      else
        out.force[i] = rho * -gravity[i];
      out.standing_force[i] = Inertia ? 0.0 : -value(rho) * gravity_old[i];
    }
  }

  /// That of the point, or, where the points are others than the soil's, of the element: by its mean void ratio, or,
  /// where it has several materials, the mean over its points.
  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION T density_at(int row, const PointFields<C, S, T>& at) const {
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
  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION T density(const Mixture& mixture, double ratio, const PointFields<C, S, T>& at) const {
    return mixture.density(mixture.porosity(ratio, at), at) - (lifted ? mixture.alpha * mixture.fluid_density : 0.0);
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

template <class F>
void BodyForce::for_each_block(const StepView& view, F&& f) const {
  const auto now = gravity_.at(view.momentum.time), old = gravity_.at(view.time_old);
  for (const SoilBlock& b : soil_->blocks) {
    const auto apply = [&](auto inertia) {
      constexpr bool accelerates = decltype(inertia)::value;
      const FieldBlock& at = accelerates ? b.mass : b;
      f(at, Weight<accelerates>{{},
                                Mixtures(*soil_, b, *view.committed),
                                !accelerates && soil_->excess,
                                {now[0], now[1], now[2]},
                                {old[0], old[1], old[2]},
                                view.committed->arrays[b.void_ratio],
                                at.points,
                                b.points});
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
  return g != Point{};
}

int BodyForce::residual(const StepView& view, const ResidualView& f) {
  if (!active(view)) return 0;
  int failures = 0;
  for_each_block(view, [&](const FieldBlock& b, const auto& law) {
    failures += add_residual(soil_->geometry, b, loop_level(view, view.momentum, b), law, f);
  });
  return failures;
}

void BodyForce::jacobian(const StepView& view, Assembler& assembler, double weight) {
  if (!active(view)) return;
  for_each_block(view, [&](const FieldBlock& b, const auto& law) {
    add_tangent(soil_->geometry, b, loop_level(view, view.momentum, b), law, assembler.scatter(b.group), weight);
  });
}

}  // namespace mudline
