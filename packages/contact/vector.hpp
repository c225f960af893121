#pragma once

#include "core/function.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// An unknown: a dual number with the derivative index `direction`, or the plain number.
template <class T>
KOKKOS_INLINE_FUNCTION T unknown(double value, int direction) {
  if constexpr (std::is_same_v<T, double>)
    return value;
  else
    return T(value, direction);
}
/// A point of the plane whose coordinates are the unknowns `first` and `first` + 1.
template <class T, class Place>
KOKKOS_INLINE_FUNCTION Vec<T, 2> unknown(const Place& x, int first) {
  return {unknown<T>(x[0], first), unknown<T>(x[1], first + 1)};
}
template <class T, int D = 2, class Place>
KOKKOS_INLINE_FUNCTION Vec<T, D> constant(const Place& x) {
  Vec<T, D> result;
  for (int i = 0; i < D; ++i) result[i] = T(x[i]);
  return result;
}
template <class T, int D>
Point plain(const Vec<T, D>& a) {
  Point result{};
  for (int i = 0; i < D; ++i) result[i] = value(a[i]);
  return result;
}

/// sum_a weight_a x_a.
template <class T, class W>
KOKKOS_INLINE_FUNCTION Vec<T, 2> combine(int count, const W* weight, const Vec<T, 2>* x) {
  Vec<T, 2> sum{T(0.0), T(0.0)};
  for (int a = 0; a < count; ++a) sum = sum + x[a] * weight[a];
  return sum;
}
/// Transpose of combine(): adds weight_a force to node a of `to`, node after node, component after component.
template <class T, class W>
KOKKOS_INLINE_FUNCTION void spread(int count, const W* weight, const Vec<T, 2>& force, T* to) {
  for (int a = 0; a < count; ++a) {
    to[2 * a] += weight[a] * force[0];
    to[2 * a + 1] += weight[a] * force[1];
  }
}

/// Forces by the N unknowns [N]: at the end of the step, and the addition to the mean over the step.
template <class T, int N>
struct StepForces {
  StepForces() {
    for (int a = 0; a < N; ++a) end[a] = more[a] = T(0.0);
  }
  /// Writes their values, and for dual numbers the derivatives of share * end + weight * more.
  template <int M>
  void write(const T& share, double weight, double (&f)[N], double (&on_top)[N], double (&k)[N][M]) const {
    for (int a = 0; a < N; ++a) {
      f[a] = value(end[a]);
      on_top[a] = value(more[a]);
      if constexpr (!std::is_same_v<T, double>) {
        const T acting = end[a] * share + weight * more[a];
        for (int b = 0; b < M; ++b) k[a][b] = acting.d[b];
      }
    }
  }
  T end[N], more[N];
};

}  // namespace mudline
