#pragma once

#include "framework/loop_level.hpp"
#include "framework/point_law.hpp"
#include "tensor/dual.hpp"

namespace mudline {

/// Derivatives of a law at a point with respect to the values and gradients of the fields there, by automatic
/// differentiation. It does not depend on the shape of the element, so that all shapes share its code.
template <class C, int S, class Law>
struct PointTangent {
  static constexpr int D = C::dim;
  using Index = LawDirections<C, S, Law>;
  using Row = LawRows<C, S, Law>;
  using Fields = PointFields<C, S, double>;
  using T = Dual<Index::count>;

  const LoopLevel& at;

  /// Makes dual numbers of the fields.
  KOKKOS_INLINE_FUNCTION void seed(const Fields& f, PointFields<C, S, T>& d) const {
    const double w = at.geometry_weight;
    d.hoop_moved = f.hoop_moved;
    d.volume_ratio = f.volume_ratio;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) d.moved[i][j] = f.moved[i][j];
    if constexpr (Law::rates) {
      d.hoop_rate = f.hoop_rate;
      for (int i = 0; i < D; ++i) {
        d.velocity[i] = f.velocity[i];
        d.acceleration[i] = f.acceleration[i];
        for (int j = 0; j < D; ++j) d.velocity_gradient[i][j] = f.velocity_gradient[i][j];
      }
      for (int k = 0; k < S; ++k) d.rate[k] = f.rate[k];
    }
    for (int k = 0; k < S; ++k) {
      d.value[k] = f.value[k];
      d.change[k] = f.change[k];
      for (int j = 0; j < D; ++j) d.gradient[k][j] = f.gradient[k][j];
    }
    if constexpr (Law::motion && !Law::shape) d.volume_ratio.d[Index::motion] = w * f.volume_ratio;
    if constexpr (Law::motion && Law::shape) {
      // a displacement gradient at the level rotates and stretches the frame of the spatial gradients
      for (int j = 0; j < D; ++j)
        for (int m = 0; m < D; ++m) {
          const int index = Index::motion + D * j + m;
          if (j == m) d.volume_ratio.d[index] = w * f.volume_ratio;
          if constexpr (Law::rates) {
            d.velocity_gradient[j][m].d[index] += at.displacement.rate;
            for (int i = 0; i < D; ++i) d.velocity_gradient[i][m].d[index] -= w * f.velocity_gradient[i][j];
          }
          for (int k = 0; k < S; ++k) d.gradient[k][m].d[index] -= w * f.gradient[k][j];
        }
      if constexpr (C::hoop) {
        d.volume_ratio.d[Index::hoop] = w * f.volume_ratio;
        if constexpr (Law::rates) d.hoop_rate.d[Index::hoop] = at.displacement.rate - w * f.hoop_rate;
      }
    }
    if constexpr (Law::inertia)
      for (int i = 0; i < D; ++i) {
        d.velocity[i].d[Index::inertia + i] = at.displacement.rate;
        d.acceleration[i].d[Index::inertia + i] = at.displacement.acceleration;
      }
    if constexpr (Law::scalars)
      for (int k = 0; k < S; ++k) {
        d.value[k].d[Index::value + k] = d.change[k].d[Index::value + k] = at.scalar[k].value;
        if constexpr (Law::rates) d.rate[k].d[Index::value + k] = at.scalar[k].rate;
      }
    if constexpr (Law::gradients)
      for (int k = 0; k < S; ++k)
        for (int j = 0; j < D; ++j) d.gradient[k][j].d[Index::gradient + D * k + j] += at.scalar[k].value;
  }

  /// Adds the derivatives of the integral with respect to the motion of the configuration: dv grows by the trace of the
  /// displacement gradient, and the gradients of the test functions change.
  KOKKOS_INLINE_FUNCTION void add_motion(PointBalance<C, S, T>& out) const {
    if constexpr (Law::motion) {
      const double w = at.geometry_weight;
      for (int j = 0; j < D; ++j)
        for (int m = 0; m < D; ++m) {
          [[maybe_unused]] const int index = D * j + m;
          if constexpr (Law::stresses)
            for (int i = 0; i < D; ++i) out.stress[i][j].d[index] -= w * out.stress[i][m].v;
          if constexpr (Law::fluxes)
            for (int k = 0; k < S; ++k) out.flux[k][j].d[index] -= w * out.flux[k][m].v;
        }
      if constexpr (C::hoop && Law::stresses) out.hoop_stress.d[D * D] -= w * out.hoop_stress.v;
      const auto grow = [&](T& x) {
        if constexpr (Law::shape)
          for (int j = 0; j < D; ++j) x.d[D * j + j] += w * x.v;
        if constexpr (C::hoop || !Law::shape) x.d[Index::hoop] += w * x.v;
      };
      for (int i = 0; i < D; ++i) {
        if constexpr (Law::forces) grow(out.force[i]);
        if constexpr (Law::stresses)
          for (int j = 0; j < D; ++j) grow(out.stress[i][j]);
      }
      if constexpr (C::hoop && Law::stresses) grow(out.hoop_stress);
      for (int k = 0; k < S; ++k) {
        if constexpr (Law::storages) grow(out.storage[k]);
        if constexpr (Law::fluxes)
          for (int j = 0; j < D; ++j) grow(out.flux[k][j]);
      }
    }
  }

  /// The law's derivatives at a point times its volume dv [m3]: (row, derivative index). row: of the point's data. It
  /// is called, not inlined: one call serves all shapes of elements.
  [[gnu::noinline]] KOKKOS_FUNCTION void operator()(int row, const Law& law, double dv, const Fields& f,
                                                    double (&A)[Row::count][Index::count]) const {
    PointFields<C, S, T> in;
    PointBalance<C, S, T> out;
    seed(f, in);
    law(row, in, out);
    add_motion(out);
    const auto put = [&](int r, const T& from) {
      for (int index = 0; index < Index::count; ++index) A[r][index] = dv * from.d[index];
    };
    for (int i = 0; i < D; ++i) {
      if constexpr (Law::forces) put(Row::force + i, out.force[i]);
      if constexpr (Law::stresses)
        for (int l = 0; l < D; ++l) put(Row::stress + D * i + l, out.stress[i][l]);
    }
    if constexpr (Law::stresses && C::hoop) put(Row::hoop, out.hoop_stress);
    for (int k = 0; k < S; ++k) {
      if constexpr (Law::storages) put(Row::storage + k, out.storage[k]);
      if constexpr (Law::fluxes)
        for (int l = 0; l < D; ++l) put(Row::flux + D * k + l, out.flux[k][l]);
    }
  }
};

}  // namespace mudline
