#pragma once

#include <Kokkos_Core.hpp>

namespace mudline {

/// det a of a matrix of one to three rows.
template <class T, int N>
KOKKOS_INLINE_FUNCTION T determinant(const T (&a)[N][N]) {
  static_assert(N >= 1 && N <= 3);
  if constexpr (N == 1)
    return a[0][0];
  else if constexpr (N == 2)
    return a[0][0] * a[1][1] - a[0][1] * a[1][0];
  else
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

/// Sum of the principal 2 x 2 minors: the second invariant of a matrix of two or three rows.
template <class T, int N>
KOKKOS_INLINE_FUNCTION T second_invariant(const T (&a)[N][N]) {
  static_assert(N == 2 || N == 3);
  T sum = a[0][0] * a[1][1] - a[0][1] * a[1][0];
  if constexpr (N == 3) sum += a[0][0] * a[2][2] - a[0][2] * a[2][0] + a[1][1] * a[2][2] - a[1][2] * a[2][1];
  return sum;
}

/// The inverse of a matrix whose determinant, not zero, is known.
template <class T, int N>
KOKKOS_INLINE_FUNCTION void invert(const T (&a)[N][N], const T& det, T (&out)[N][N]) {
  static_assert(N >= 1 && N <= 3);
  const T factor = 1.0 / det;
  if constexpr (N == 1) {
    out[0][0] = factor;
  } else if constexpr (N == 2) {
    out[0][0] = a[1][1] * factor;
    out[0][1] = -a[0][1] * factor;
    out[1][0] = -a[1][0] * factor;
    out[1][1] = a[0][0] * factor;
  } else {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        out[j][i] = (a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1]) * factor;
      }
  }
}

}  // namespace mudline
