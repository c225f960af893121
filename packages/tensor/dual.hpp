#pragma once

#include <math.h>  // the unqualified functions exist on every device, std:: ones need compiler flags

#include <Kokkos_Macros.hpp>

#include <type_traits>

namespace mudline {

/// Forward dual number: a value and its derivatives in N directions, exact to rounding.
/// A law written as a template on its number type gives its tangent when evaluated with Dual<6> strain:
///     (v, d) o (w, e) = (v o w, (do/dv) d + (do/dw) e)
/// Comparisons look at the value only, so branches are those of the plain evaluation.
/// Derivatives come first and aligned, so that copies move the same pairs of numbers that arithmetic stores; a load
/// that straddles two recent stores stalls the processor, and costs more than the arithmetic itself.
template <int N>
struct alignas(16) Dual {
  double d[N];
  double v;

  Dual() = default;                                       // undefined, as a double is
  KOKKOS_INLINE_FUNCTION Dual(double value) : v(value) {  // NOLINT: a number is a constant dual
    for (int i = 0; i < N; ++i) d[i] = 0.0;
  }
  /// The independent variable number `direction`.
  KOKKOS_INLINE_FUNCTION Dual(double value, int direction) : Dual(value) { d[direction] = 1.0; }

  KOKKOS_INLINE_FUNCTION Dual& operator+=(const Dual& b) { return *this = *this + b; }
  KOKKOS_INLINE_FUNCTION Dual& operator-=(const Dual& b) { return *this = *this - b; }
  KOKKOS_INLINE_FUNCTION Dual& operator*=(const Dual& b) { return *this = *this * b; }
  KOKKOS_INLINE_FUNCTION Dual& operator/=(const Dual& b) { return *this = *this / b; }
  KOKKOS_INLINE_FUNCTION Dual& operator+=(double b) {
    v += b;
    return *this;
  }
  KOKKOS_INLINE_FUNCTION Dual& operator-=(double b) {
    v -= b;
    return *this;
  }
  KOKKOS_INLINE_FUNCTION Dual& operator*=(double b) { return *this = *this * b; }
  KOKKOS_INLINE_FUNCTION Dual& operator/=(double b) { return *this = *this / b; }

  friend KOKKOS_INLINE_FUNCTION Dual operator+(const Dual& a, const Dual& b) {
    Dual r;
    for (int i = 0; i < N; ++i) r.d[i] = a.d[i] + b.d[i];
    r.v = a.v + b.v;
    return r;
  }
  friend KOKKOS_INLINE_FUNCTION Dual operator-(const Dual& a, const Dual& b) {
    Dual r;
    for (int i = 0; i < N; ++i) r.d[i] = a.d[i] - b.d[i];
    r.v = a.v - b.v;
    return r;
  }
  friend KOKKOS_INLINE_FUNCTION Dual operator*(const Dual& a, const Dual& b) {
    Dual r;
    for (int i = 0; i < N; ++i) r.d[i] = a.d[i] * b.v + a.v * b.d[i];
    r.v = a.v * b.v;
    return r;
  }
  /// The value is the plain quotient, not a product with the reciprocal, so that it has the bits of the double version.
  friend KOKKOS_INLINE_FUNCTION Dual operator/(const Dual& a, const Dual& b) {
    Dual r;
    const double reciprocal = 1.0 / b.v;
    r.v = a.v / b.v;
    for (int i = 0; i < N; ++i) r.d[i] = (a.d[i] - r.v * b.d[i]) * reciprocal;
    return r;
  }
  friend KOKKOS_INLINE_FUNCTION Dual operator-(const Dual& a) { return a.chain(-a.v, -1.0); }
  friend KOKKOS_INLINE_FUNCTION Dual operator+(const Dual& a, double b) { return a.chain(a.v + b, 1.0); }
  friend KOKKOS_INLINE_FUNCTION Dual operator+(double a, const Dual& b) { return b.chain(a + b.v, 1.0); }
  friend KOKKOS_INLINE_FUNCTION Dual operator-(const Dual& a, double b) { return a.chain(a.v - b, 1.0); }
  friend KOKKOS_INLINE_FUNCTION Dual operator-(double a, const Dual& b) { return b.chain(a - b.v, -1.0); }
  friend KOKKOS_INLINE_FUNCTION Dual operator*(const Dual& a, double b) { return a.chain(a.v * b, b); }
  friend KOKKOS_INLINE_FUNCTION Dual operator*(double a, const Dual& b) { return b.chain(a * b.v, a); }
  friend KOKKOS_INLINE_FUNCTION Dual operator/(const Dual& a, double b) { return a.chain(a.v / b, 1.0 / b); }
  friend KOKKOS_INLINE_FUNCTION Dual operator/(double a, const Dual& b) { return b.chain(a / b.v, -a / b.v / b.v); }

  /// The function value f with derivatives slope * d.
  KOKKOS_INLINE_FUNCTION Dual chain(double f, double slope) const {
    Dual r;
    for (int i = 0; i < N; ++i) r.d[i] = slope * d[i];
    r.v = f;
    return r;
  }
};

/// The plain number in a double or a dual.
KOKKOS_INLINE_FUNCTION double value(double a) { return a; }
template <int N>
KOKKOS_INLINE_FUNCTION double value(const Dual<N>& a) {
  return a.v;
}

/// A function of one variable of which value and slope at a are known.
KOKKOS_INLINE_FUNCTION double chain(double, double f, double) { return f; }
template <int N>
KOKKOS_INLINE_FUNCTION Dual<N> chain(const Dual<N>& a, double f, double slope) {
  return a.chain(f, slope);
}

/// `a` as another kind of number: itself where the kinds agree, else its value without derivatives.
template <class T, class S>
KOKKOS_INLINE_FUNCTION T number_as(const S& a) {
  if constexpr (std::is_same_v<T, S>)
    return a;
  else
    return T(value(a));
}

/// Square root; its derivative at 0 is infinite, callers keep away from it.
KOKKOS_INLINE_FUNCTION double square_root(double a) { return ::sqrt(a); }
template <int N>
KOKKOS_INLINE_FUNCTION Dual<N> square_root(const Dual<N>& a) {
  const double f = ::sqrt(a.v);
  return a.chain(f, 0.5 / f);
}

KOKKOS_INLINE_FUNCTION double exponential(double a) { return ::exp(a); }
template <int N>
KOKKOS_INLINE_FUNCTION Dual<N> exponential(const Dual<N>& a) {
  const double f = ::exp(a.v);
  return a.chain(f, f);
}

KOKKOS_INLINE_FUNCTION double logarithm(double a) { return ::log(a); }
template <int N>
KOKKOS_INLINE_FUNCTION Dual<N> logarithm(const Dual<N>& a) {
  return a.chain(::log(a.v), 1.0 / a.v);
}

namespace detail {
/// (exp(z) - 1)/z and its derivative; a Taylor series near 0, where the closed form of the derivative cancels.
KOKKOS_INLINE_FUNCTION void exponential_quotient(double z, double& f, double& slope) {
  if (::fabs(z) > 0.25) {
    f = ::expm1(z) / z;
    slope = (::exp(z) - f) / z;
    return;
  }
  f = slope = 0.0;
  double term = 1.0;  // z^k / (k+1)!
  for (int k = 0; k < 12 && ::fabs(term) > 1e-19; ++k) {
    f += term;
    slope += term * (k + 1) / (k + 2);  // d/dz of z^(k+1)/(k+2)!
    term *= z / (k + 2);
  }
}
}  // namespace detail

/// (exp(z) - 1)/z, equal to 1 at z = 0.
KOKKOS_INLINE_FUNCTION double exponential_quotient(double z) {
  double f, slope;
  detail::exponential_quotient(z, f, slope);
  return f;
}
template <int N>
KOKKOS_INLINE_FUNCTION Dual<N> exponential_quotient(const Dual<N>& z) {
  double f, slope;
  detail::exponential_quotient(z.v, f, slope);
  return z.chain(f, slope);
}

}  // namespace mudline
