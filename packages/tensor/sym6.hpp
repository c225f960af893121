#pragma once

#include "tensor/dual.hpp"

namespace mudline {

/// Symmetric 3x3 tensors as six numbers xx yy zz yz xz xy, tension positive. A stress holds tensor components; a strain
/// (and a derivative with respect to stress) holds engineering shear, i.e. twice the tensor component, so that work and
/// directional derivatives are plain sums of six products. All functions take double or Dual components.
///
/// Invariants of a stress: p' = -tr(sigma)/3 (compression positive), s = sigma + p' 1, q = sqrt(3/2 s:s),
/// J3 = det s. Lode measure S = (27/2) J3/q^3 = sin(3 theta): -1 in triaxial compression, +1 in extension
/// (the sign of Sheng, Sloan & Yu 2000, Computational Mechanics 26).
namespace sym6 {

template <class T>
KOKKOS_INLINE_FUNCTION T trace(const T* a) {
  return a[0] + a[1] + a[2];
}

/// Sum of six products: stress times strain.
template <class T>
KOKKOS_INLINE_FUNCTION T work(const T* stress, const T* strain) {
  T sum = stress[0] * strain[0];
  for (int i = 1; i < 6; ++i) sum += stress[i] * strain[i];
  return sum;
}

/// Tensor norm squared of a stress: shear components count twice.
template <class T>
KOKKOS_INLINE_FUNCTION T norm_squared(const T* stress) {
  const T normal = stress[0] * stress[0] + stress[1] * stress[1] + stress[2] * stress[2];
  return normal + 2.0 * (stress[3] * stress[3] + stress[4] * stress[4] + stress[5] * stress[5]);
}

/// Mean stress, compression positive.
template <class T>
KOKKOS_INLINE_FUNCTION T mean_pressure(const T* stress) {
  return trace(stress) * (-1.0 / 3.0);
}

/// s = sigma + p' 1; returns p'.
template <class T>
KOKKOS_INLINE_FUNCTION T deviator(const T* stress, T* s) {
  const T p = mean_pressure(stress);
  for (int i = 0; i < 3; ++i) s[i] = stress[i] + p;
  for (int i = 3; i < 6; ++i) s[i] = stress[i];
  return p;
}

/// det of a tensor with stress-like components.
template <class T>
KOKKOS_INLINE_FUNCTION T determinant(const T* a) {
  return a[0] * (a[1] * a[2] - a[3] * a[3]) - a[5] * (a[5] * a[2] - a[3] * a[4]) + a[4] * (a[5] * a[3] - a[1] * a[4]);
}

/// d det(s)/d sigma for a deviator s with q^2 = 3/2 s:s, i.e. s.s - (2/9) q^2 1, as a strain-like six-vector.
template <class T>
KOKKOS_INLINE_FUNCTION void determinant_gradient(const T* s, const T& q_squared, T* g) {
  const T third = q_squared * (2.0 / 9.0);
  g[0] = s[0] * s[0] + s[5] * s[5] + s[4] * s[4] - third;
  g[1] = s[5] * s[5] + s[1] * s[1] + s[3] * s[3] - third;
  g[2] = s[4] * s[4] + s[3] * s[3] + s[2] * s[2] - third;
  g[3] = 2.0 * (s[5] * s[4] + s[1] * s[3] + s[3] * s[2]);
  g[4] = 2.0 * (s[0] * s[4] + s[5] * s[3] + s[4] * s[2]);
  g[5] = 2.0 * (s[0] * s[5] + s[5] * s[1] + s[4] * s[3]);
}

/// q, p' and S of a stress; S is 0 where q vanishes.
struct Invariants {
  double p, q, lode;
};
KOKKOS_INLINE_FUNCTION Invariants invariants(const double* stress) {
  double s[6];
  Invariants r;
  r.p = deviator(stress, s);
  r.q = ::sqrt(1.5 * norm_squared(s));
  const double cube = r.q * r.q * r.q;
  r.lode = cube > 0.0 ? ::fmax(-1.0, ::fmin(1.0, 13.5 * determinant(s) / cube)) : 0.0;
  return r;
}

/// Principal stresses, largest (most tensile) first.
KOKKOS_INLINE_FUNCTION void principal_values(const double* stress, double* principal) {
  const Invariants r = invariants(stress);
  const double turn = 2.0943951023931953;     // 120 degrees
  const double angle = ::acos(r.lode) / 3.0;  // cos(3 angle) = S
  for (int i = 0; i < 3; ++i) principal[i] = -r.p + 2.0 / 3.0 * r.q * ::cos(angle - i * turn);
  const double last = principal[2];  // cos(angle - 240) is the middle one
  principal[2] = ::fmin(principal[1], last);
  principal[1] = ::fmax(principal[1], last);
}

/// R a R^T for a row-major rotation R and stress-like components.
KOKKOS_INLINE_FUNCTION void rotate(const double* r, const double* a, double* out) {
  const double full[9] = {a[0], a[5], a[4], a[5], a[1], a[3], a[4], a[3], a[2]};
  double half[9];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      half[3 * i + j] = r[3 * i] * full[j] + r[3 * i + 1] * full[3 + j] + r[3 * i + 2] * full[6 + j];
  const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  for (int c = 0; c < 6; ++c) {
    const double* h = half + 3 * row[c];
    const double* t = r + 3 * column[c];
    out[c] = h[0] * t[0] + h[1] * t[1] + h[2] * t[2];
  }
}

/// Isotropic elasticity: K tr(strain) 1 + 2 G dev(strain), engineering shear in, stress out.
template <class T, class Modulus>
KOKKOS_INLINE_FUNCTION void isotropic(const Modulus& bulk, const Modulus& shear, const T* strain, T* stress) {
  const T volume = trace(strain);
  const T mean = (bulk - shear * (2.0 / 3.0)) * volume;
  for (int i = 0; i < 3; ++i) stress[i] = mean + 2.0 * shear * strain[i];
  for (int i = 3; i < 6; ++i) stress[i] = shear * strain[i];
}

/// The isotropic elastic stiffness as a row-major 6x6 matrix.
KOKKOS_INLINE_FUNCTION void isotropic_stiffness(double bulk, double shear, double* d) {
  for (int i = 0; i < 36; ++i) d[i] = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) d[6 * i + j] = bulk - shear * (2.0 / 3.0);
  for (int i = 0; i < 3; ++i) d[7 * i] += 2.0 * shear;
  for (int i = 3; i < 6; ++i) d[7 * i] = shear;
}

}  // namespace sym6
}  // namespace mudline
