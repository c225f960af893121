#pragma once

#include "geometry/contour_piece.hpp"
#include "tensor/dual.hpp"

namespace mudline {

/// A vector of the plane whose components are numbers of kind T: double, or a dual number.
template <class T>
struct PlaneVector {
  T x, y;
  const T& operator[](int i) const { return i == 0 ? x : y; }
  PlaneVector operator+(const PlaneVector& b) const { return {x + b.x, y + b.y}; }
  PlaneVector operator-(const PlaneVector& b) const { return {x - b.x, y - b.y}; }
  template <class S>
  PlaneVector operator*(const S& b) const {
    return {x * b, y * b};
  }
  PlaneVector operator/(const T& b) const { return {x / b, y / b}; }
};
template <class T>
PlaneVector<T> vector(const T (&x)[2]) {
  return {x[0], x[1]};
}

template <class T>
T dot(const PlaneVector<T>& a, const PlaneVector<T>& b) {
  return a.x * b.x + a.y * b.y;
}
/// z component of a x b.
template <class T>
T cross(const PlaneVector<T>& a, const PlaneVector<T>& b) {
  return a.x * b.y - a.y * b.x;
}
template <class T>
T length(const PlaneVector<T>& a) {
  return square_root(dot(a, a));
}

/// The unknown number `direction`: with its derivative, or the plain number.
template <class T>
T unknown(double value, int direction) {
  if constexpr (std::is_same_v<T, double>)
    return value;
  else
    return T(value, direction);
}
/// A point whose coordinates are the unknowns `first` and `first` + 1.
template <class T>
PlaneVector<T> unknown(const PlanePoint& x, int first) {
  return {unknown<T>(x[0], first), unknown<T>(x[1], first + 1)};
}
template <class T>
PlaneVector<T> constant(const PlanePoint& x) {
  return {T(x[0]), T(x[1])};
}
template <class T>
PlanePoint plain(const PlaneVector<T>& a) {
  return {value(a.x), value(a.y)};
}

/// sum_a weight_a x_a.
template <class T, class W>
PlaneVector<T> combine(int count, const W* weight, const PlaneVector<T>* x) {
  PlaneVector<T> sum{T(0.0), T(0.0)};
  for (int a = 0; a < count; ++a) sum = sum + x[a] * weight[a];
  return sum;
}
/// The transpose: adds weight_a force to node a of `to`, node after node, component after component.
template <class T, class W>
void spread(int count, const W* weight, const PlaneVector<T>& force, T* to) {
  for (int a = 0; a < count; ++a) {
    to[2 * a] += weight[a] * force.x;
    to[2 * a + 1] += weight[a] * force.y;
  }
}

/// Forces by the N unknowns [N]: at the end of the step, and what comes on top in the mean over it.
template <class T, int N>
struct StepForces {
  StepForces() {
    for (int a = 0; a < N; ++a) end[a] = more[a] = T(0.0);
  }
  /// Their values, and with dual numbers the derivatives of share * end + weight * more.
  void write(const T& share, double weight, double (&f)[N], double (&on_top)[N], double (&k)[N][N]) const {
    for (int a = 0; a < N; ++a) {
      f[a] = value(end[a]);
      on_top[a] = value(more[a]);
      if constexpr (!std::is_same_v<T, double>) {
        const T acting = end[a] * share + weight * more[a];
        for (int b = 0; b < N; ++b) k[a][b] = acting.d[b];
      }
    }
  }
  T end[N], more[N];
};

}  // namespace mudline
