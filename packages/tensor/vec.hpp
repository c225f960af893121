#pragma once

#include <cmath>

#include "tensor/dual.hpp"

namespace mudline {

/// A vector of D components of the number type T: double, or a dual number.
template <class T, int D>
struct Vec {
  T at[D];
  KOKKOS_INLINE_FUNCTION constexpr T& operator[](int i) { return at[i]; }
  KOKKOS_INLINE_FUNCTION constexpr const T& operator[](int i) const { return at[i]; }
  KOKKOS_INLINE_FUNCTION static constexpr int size() { return D; }
  KOKKOS_INLINE_FUNCTION constexpr T* data() { return at; }
  KOKKOS_INLINE_FUNCTION constexpr const T* data() const { return at; }
  KOKKOS_INLINE_FUNCTION constexpr T* begin() { return at; }
  KOKKOS_INLINE_FUNCTION constexpr T* end() { return at + D; }
  KOKKOS_INLINE_FUNCTION constexpr const T* begin() const { return at; }
  KOKKOS_INLINE_FUNCTION constexpr const T* end() const { return at + D; }

  KOKKOS_INLINE_FUNCTION static Vec zero() {
    Vec result;
    for (int i = 0; i < D; ++i) result[i] = T(0.0);
    return result;
  }
  friend KOKKOS_INLINE_FUNCTION Vec operator+(const Vec& a, const Vec& b) {
    Vec result;
    for (int i = 0; i < D; ++i) result[i] = a[i] + b[i];
    return result;
  }
  friend KOKKOS_INLINE_FUNCTION Vec operator-(const Vec& a, const Vec& b) {
    Vec result;
    for (int i = 0; i < D; ++i) result[i] = a[i] - b[i];
    return result;
  }
  friend KOKKOS_INLINE_FUNCTION Vec operator-(const Vec& a) {
    Vec result;
    for (int i = 0; i < D; ++i) result[i] = -a[i];
    return result;
  }
  template <class S>
  friend KOKKOS_INLINE_FUNCTION Vec operator*(const Vec& a, const S& b) {
    Vec result;
    for (int i = 0; i < D; ++i) result[i] = a[i] * b;
    return result;
  }
  friend KOKKOS_INLINE_FUNCTION Vec operator*(double a, const Vec& b) { return b * a; }
  friend KOKKOS_INLINE_FUNCTION Vec operator/(const Vec& a, const T& b) {
    Vec result;
    for (int i = 0; i < D; ++i) result[i] = a[i] / b;
    return result;
  }
  KOKKOS_INLINE_FUNCTION Vec& operator+=(const Vec& b) { return *this = *this + b; }
  KOKKOS_INLINE_FUNCTION Vec& operator-=(const Vec& b) { return *this = *this - b; }

  friend constexpr bool operator==(const Vec& a, const Vec& b) {
    for (int i = 0; i < D; ++i)
      if (!(a[i] == b[i])) return false;
    return true;
  }
  friend constexpr bool operator!=(const Vec& a, const Vec& b) { return !(a == b); }
  /// Lexicographic order, for sorted containers.
  friend constexpr bool operator<(const Vec& a, const Vec& b) {
    for (int i = 0; i < D; ++i) {
      if (a[i] < b[i]) return true;
      if (b[i] < a[i]) return false;
    }
    return false;
  }
};

template <class T, int D>
KOKKOS_INLINE_FUNCTION T dot(const Vec<T, D>& a, const Vec<T, D>& b) {
  T sum = a[0] * b[0];
  for (int i = 1; i < D; ++i) sum += a[i] * b[i];
  return sum;
}
/// z component of a x b.
template <class T>
KOKKOS_INLINE_FUNCTION T cross(const Vec<T, 2>& a, const Vec<T, 2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}
template <class T>
KOKKOS_INLINE_FUNCTION Vec<T, 3> cross(const Vec<T, 3>& a, const Vec<T, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class T, int D>
KOKKOS_INLINE_FUNCTION T length(const Vec<T, D>& a) {
  return square_root(dot(a, a));
}
/// Unit vector in the direction of a; zero where a is zero.
template <int D>
KOKKOS_INLINE_FUNCTION Vec<double, D> unit(const Vec<double, D>& a) {
  const double size = length(a);
  return 1 / (size > 1e-300 ? size : 1e-300) * a;
}

/// A point or a vector of the deck's space [m]. Plane strain: x, y, 0. Axisymmetric: r, z, 0. In space: x, y, z.
using Point = Vec<double, 3>;
/// A point or a vector of the plane [m]. Plane strain: x, y. Axisymmetric: r, z.
using PlanePoint = Vec<double, 2>;

}  // namespace mudline
