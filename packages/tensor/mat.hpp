#pragma once

#include "tensor/vec.hpp"

namespace mudline {

/// A square matrix of N rows of the number type T: double, or a dual number.
template <class T, int N>
struct Mat {
  T at[N][N];
  using Row = T[N];
  KOKKOS_INLINE_FUNCTION constexpr Row& operator[](int i) { return at[i]; }
  KOKKOS_INLINE_FUNCTION constexpr const Row& operator[](int i) const { return at[i]; }
  /// The components row after row.
  KOKKOS_INLINE_FUNCTION constexpr T* data() { return at[0]; }
  KOKKOS_INLINE_FUNCTION constexpr const T* data() const { return at[0]; }

  friend KOKKOS_INLINE_FUNCTION Vec<T, N> operator*(const Mat& a, const Vec<T, N>& x) {
    Vec<T, N> result = Vec<T, N>::zero();
    for (int i = 0; i < N; ++i)
      for (int k = 0; k < N; ++k) result[i] += a[i][k] * x[k];
    return result;
  }
  friend KOKKOS_INLINE_FUNCTION Mat operator*(const Mat& a, const Mat& b) {
    Mat result;
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j) {
        result[i][j] = T(0.0);
        for (int k = 0; k < N; ++k) result[i][j] += a[i][k] * b[k][j];
      }
    return result;
  }
};

template <class T, int N>
KOKKOS_INLINE_FUNCTION Mat<T, N> transposed(const Mat<T, N>& a) {
  Mat<T, N> result;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) result[i][j] = a[j][i];
  return result;
}

/// det a of a matrix of one to three rows.
template <class T, int N>
KOKKOS_INLINE_FUNCTION T determinant(const Mat<T, N>& a) {
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
KOKKOS_INLINE_FUNCTION T second_invariant(const Mat<T, N>& a) {
  static_assert(N == 2 || N == 3);
  T sum = a[0][0] * a[1][1] - a[0][1] * a[1][0];
  if constexpr (N == 3) sum += a[0][0] * a[2][2] - a[0][2] * a[2][0] + a[1][1] * a[2][2] - a[1][2] * a[2][1];
  return sum;
}

/// The inverse of a matrix whose determinant, not zero, is known.
template <class T, int N>
KOKKOS_INLINE_FUNCTION void invert(const Mat<T, N>& a, const T& det, Mat<T, N>& out) {
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
