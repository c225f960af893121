#pragma once

#include "tensor/dual.hpp"

namespace mudline {

/// A vector of the plane or of space whose components are numbers of kind T: double, or a dual number.
template <class T, int D>
struct SpatialVector {
  T at[D];
  KOKKOS_INLINE_FUNCTION T& operator[](int i) { return at[i]; }
  KOKKOS_INLINE_FUNCTION const T& operator[](int i) const { return at[i]; }
  KOKKOS_INLINE_FUNCTION static SpatialVector zero() {
    SpatialVector result;
    for (int i = 0; i < D; ++i) result[i] = T(0.0);
    return result;
  }
  friend KOKKOS_INLINE_FUNCTION SpatialVector operator+(const SpatialVector& a, const SpatialVector& b) {
    SpatialVector result;
    for (int i = 0; i < D; ++i) result[i] = a[i] + b[i];
    return result;
  }
  friend KOKKOS_INLINE_FUNCTION SpatialVector operator-(const SpatialVector& a, const SpatialVector& b) {
    SpatialVector result;
    for (int i = 0; i < D; ++i) result[i] = a[i] - b[i];
    return result;
  }
  template <class S>
  friend KOKKOS_INLINE_FUNCTION SpatialVector operator*(const SpatialVector& a, const S& b) {
    SpatialVector result;
    for (int i = 0; i < D; ++i) result[i] = a[i] * b;
    return result;
  }
  friend KOKKOS_INLINE_FUNCTION SpatialVector operator/(const SpatialVector& a, const T& b) {
    SpatialVector result;
    for (int i = 0; i < D; ++i) result[i] = a[i] / b;
    return result;
  }
};

template <class T, int D>
KOKKOS_INLINE_FUNCTION T dot(const SpatialVector<T, D>& a, const SpatialVector<T, D>& b) {
  T sum = a[0] * b[0];
  for (int i = 1; i < D; ++i) sum += a[i] * b[i];
  return sum;
}
/// z component of a x b.
template <class T>
KOKKOS_INLINE_FUNCTION T cross(const SpatialVector<T, 2>& a, const SpatialVector<T, 2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}
template <class T>
KOKKOS_INLINE_FUNCTION SpatialVector<T, 3> cross(const SpatialVector<T, 3>& a, const SpatialVector<T, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class T, int D>
KOKKOS_INLINE_FUNCTION T length(const SpatialVector<T, D>& a) {
  return square_root(dot(a, a));
}

}  // namespace mudline
