#pragma once

#include "tensor/sym6.hpp"

namespace mudline {

/// Representations of stresses and strains in the integration of a plastic law, with the products that it needs.
/// `stress` and `strain` are `size` numbers each; sums and multiples are those of the numbers.

/// All six components of sym6.
struct SixComponents {
  static constexpr int size = 6;

  template <class T>
  KOKKOS_INLINE_FUNCTION T trace(const T* strain) const {
    return sym6::trace(strain);
  }
  /// Compression positive.
  template <class T>
  KOKKOS_INLINE_FUNCTION T mean_pressure(const T* stress) const {
    return sym6::mean_pressure(stress);
  }
  /// The deviator of a stress; returns the mean pressure.
  template <class T>
  KOKKOS_INLINE_FUNCTION T deviator(const T* stress, T* s) const {
    return sym6::deviator(stress, s);
  }
  template <class T>
  KOKKOS_INLINE_FUNCTION T norm_squared(const T* stress) const {
    return sym6::norm_squared(stress);
  }
  template <class T>
  KOKKOS_INLINE_FUNCTION T work(const T* stress, const T* strain) const {
    return sym6::work(stress, strain);
  }
  template <class T, class Modulus>
  KOKKOS_INLINE_FUNCTION void isotropic(const Modulus& bulk, const Modulus& shear, const T* strain, T* stress) const {
    sym6::isotropic(bulk, shear, strain, stress);
  }
  /// The strain volume/3 1 + factor s, for a stress deviator s.
  template <class T>
  KOKKOS_INLINE_FUNCTION void strain_along(const T& volume, const T& factor, const T* s, T* strain) const {
    const T third = volume * (1.0 / 3.0);
    for (int i = 0; i < 3; ++i) strain[i] = factor * s[i] + third;
    for (int i = 3; i < 6; ++i) strain[i] = 2.0 * factor * s[i];
  }
  /// A strain as a tensor in the representation of a stress.
  template <class T>
  KOKKOS_INLINE_FUNCTION void as_stress(const T* strain, T* stress) const {
    for (int i = 0; i < 6; ++i) stress[i] = strain[i] * (i < 3 ? 1.0 : 0.5);
  }
  /// largest(): largest component of a stress; unit(): magnitude of number i of a stress relative to a component.
  KOKKOS_INLINE_FUNCTION double largest(const double* stress) const {
    double most = 0.0;
    for (int i = 0; i < 6; ++i) most = ::fmax(most, ::fabs(stress[i]));
    return most;
  }
  KOKKOS_INLINE_FUNCTION double unit(int) const { return 1.0; }
};

/// The stress of a law that depends on p' and q only stays, within one increment, in the space of the unit tensor, the
/// deviator S of the stress at the start and the deviator E of the strain increment:
///     stress = mean 1 + a S + b E (three numbers, tension positive),  strain = volume/3 1 + a S + b E
/// The products need S:S, S:E and E:E only. With T a dual number these carry derivatives; the independent variables are
/// the volume strain, S:E and E:E, so that three derivative indices are enough for all strains.
template <class T>
struct TwoDeviators {
  static constexpr int size = 3;
  double ss;  // [Pa2] S:S
  T se, ee;   // [Pa] S:E, [-] E:E

  template <class X>
  KOKKOS_INLINE_FUNCTION X trace(const X* strain) const {
    return strain[0];
  }
  template <class X>
  KOKKOS_INLINE_FUNCTION X mean_pressure(const X* stress) const {
    return -1.0 * stress[0];
  }
  template <class X>
  KOKKOS_INLINE_FUNCTION X deviator(const X* stress, X* s) const {
    s[0] = X(0.0);
    s[1] = stress[1];
    s[2] = stress[2];
    return mean_pressure(stress);
  }
  template <class X>
  KOKKOS_INLINE_FUNCTION X norm_squared(const X* stress) const {
    return 3.0 * stress[0] * stress[0] + product(stress, stress);
  }
  template <class X>
  KOKKOS_INLINE_FUNCTION X work(const X* stress, const X* strain) const {
    return stress[0] * strain[0] + product(stress, strain);
  }
  template <class X, class Modulus>
  KOKKOS_INLINE_FUNCTION void isotropic(const Modulus& bulk, const Modulus& shear, const X* strain, X* stress) const {
    stress[0] = bulk * strain[0];
    const Modulus twice = 2.0 * shear;
    stress[1] = twice * strain[1];
    stress[2] = twice * strain[2];
  }
  template <class X>
  KOKKOS_INLINE_FUNCTION void strain_along(const X& volume, const X& factor, const X* s, X* strain) const {
    strain[0] = volume;
    strain[1] = factor * s[1];
    strain[2] = factor * s[2];
  }
  template <class X>
  KOKKOS_INLINE_FUNCTION void as_stress(const X* strain, X* stress) const {
    stress[0] = strain[0] * (1.0 / 3.0);
    stress[1] = strain[1];
    stress[2] = strain[2];
  }
  KOKKOS_INLINE_FUNCTION double largest(const double* stress) const {
    return ::fmax(::fabs(stress[0]), ::fmax(::fabs(stress[1]) / unit(1), ::fabs(stress[2]) / unit(2)));
  }
  KOKKOS_INLINE_FUNCTION double unit(int i) const {
    const double square = i == 1 ? ss : value(ee);
    return i > 0 && square > 0.0 ? 1.0 / ::sqrt(square) : 1.0;
  }

 private:
  template <class X>
  KOKKOS_INLINE_FUNCTION X product(const X* a, const X* b) const {
    const X mixed = number_as<X>(se);
    return a[1] * (ss * b[1] + mixed * b[2]) + a[2] * (mixed * b[1] + number_as<X>(ee) * b[2]);
  }
};

/// One increment in that space, with conversion from and to six components.
template <class T>
struct IncrementOfTwoDeviators {
  static constexpr int directions = 3;  // number of derivative indices of T
  double old[6], s[6], e[6], mean;      // stress at the start, its deviator S, E as a tensor, mean stress at the start
  TwoDeviators<T> space;
  T strain[3];

  KOKKOS_INLINE_FUNCTION IncrementOfTwoDeviators(const double* stress, const double* increment) {
    for (int i = 0; i < 6; ++i) old[i] = stress[i];
    mean = -sym6::deviator(stress, s);
    const double volume = sym6::trace(increment);
    for (int i = 0; i < 6; ++i) e[i] = i < 3 ? increment[i] - volume / 3.0 : 0.5 * increment[i];
    double se = 0.0;
    for (int i = 0; i < 6; ++i) se += (i < 3 ? 1.0 : 2.0) * s[i] * e[i];
    space.ss = sym6::norm_squared(s);
    space.se = T(se);
    space.ee = T(sym6::norm_squared(e));
    strain[0] = T(volume);
    strain[1] = T(0.0);
    strain[2] = T(1.0);
    if constexpr (!std::is_same_v<T, double>) strain[0].d[0] = space.se.d[1] = space.ee.d[2] = 1.0;
  }
  KOKKOS_INLINE_FUNCTION void start(T* stress) const {
    stress[0] = T(mean);
    stress[1] = T(1.0);
    stress[2] = T(0.0);
  }
  /// Writes the stress as a change of the old one, so that a zero strain leaves it unchanged bit for bit.
  KOKKOS_INLINE_FUNCTION void write(const T* stress, double* out) const {
    const double m = value(stress[0]) - mean, a = value(stress[1]) - 1.0, b = value(stress[2]);
    for (int i = 0; i < 6; ++i) out[i] = old[i] + ((i < 3 ? m : 0.0) + a * s[i] + b * e[i]);
  }
  /// d stress / d strain, row-major, engineering shear.
  KOKKOS_INLINE_FUNCTION void write_tangent(const T* stress, double* tangent) const {
    // derivatives of the independent variables with respect to the strain: 1, S, 2 E
    const double b = value(stress[2]);
    double by[3][6];  // derivatives of the three numbers of the stress
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 6; ++j)
        by[k][j] = (j < 3 ? stress[k].d[0] : 0.0) + stress[k].d[1] * s[j] + 2.0 * stress[k].d[2] * e[j];
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) tangent[6 * i + j] = (i < 3 ? by[0][j] : 0.0) + s[i] * by[1][j] + e[i] * by[2][j];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) tangent[6 * i + j] -= b / 3.0;
      tangent[7 * i] += b;
      tangent[7 * (i + 3)] += 0.5 * b;
    }
  }
};

}  // namespace mudline
