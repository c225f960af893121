#pragma once

#include "tensor/dual.hpp"

namespace mudline {

/// Power of a positive number with a constant exponent.
template <class T>
KOKKOS_INLINE_FUNCTION T power(const T& a, double exponent) {
  const double f = ::pow(value(a), exponent);
  return chain(a, f, exponent * f / value(a));
}

/// Solves dy/ds = f(s, y) from s = 0 to 1 by the Runge-Kutta pair of orders 3 and 2 of Bogacki and Shampine (1989,
/// Appl. Math. Letters 2:321), whose last stage is the first one of the next step. The system has these members:
///     bool rates(const T& s, const T* y, T* dy) const;     false: y is not admissible, the step is cut
///     T error_squared(const T* y, const T* error) const;   of one step, in units of the tolerance
///     T first_step(const T* y, const T* dy) const;         small enough not to be rejected as a rule
///     T largest_step(const T& s, const T* y) const;        for the stability of an explicit method
/// With T a dual number the sizes of the steps carry derivatives too, so that the derivative of the result is that of
/// what was computed.
template <class T, int N, class System>
class EmbeddedSteps {
 public:
  KOKKOS_INLINE_FUNCTION explicit EmbeddedSteps(const System& system) : system_(system) {}

  /// Moves y over the whole interval with at most `attempts` steps, rejected ones included. Returns false, with y in an
  /// undefined state, if they do not suffice.
  KOKKOS_INLINE_FUNCTION bool integrate(T* y, int attempts) {
    T s(0.0);
    double growth = 3.0;
    if (!system_.rates(s, y, k_[0])) return false;
    T step = system_.first_step(y, k_[0]);
    for (int n = 0; n < attempts; ++n) {
      const T rest = 1.0 - s, most = system_.largest_step(s, y);
      if (value(step) > value(most)) step = most;
      const bool last = !(value(step) < value(rest));
      if (last) step = rest;
      T error_squared;
      const bool evaluated = try_step(s, y, step, error_squared);
      if (!evaluated) {
        step *= 0.25;
        growth = 1.0;
        continue;
      }
      const T factor = next_factor(error_squared, growth);
      const bool accepted = value(error_squared) <= 1.0;
      if (accepted) {
        copy(new_y_, y);
        if (last) return true;
        copy(k_[3], k_[0]);
        s += step;
      }
      step *= factor;
      growth = accepted ? 3.0 : 1.0;
    }
    return false;
  }

 private:
  KOKKOS_INLINE_FUNCTION static void copy(const T* from, T* to) {
    for (int i = 0; i < N; ++i) to[i] = from[i];
  }

  /// Fills new_y_ and the stages; false where a stage cannot be evaluated.
  KOKKOS_INLINE_FUNCTION bool try_step(const T& s, const T* y, const T& step, T& error_squared) {
    for (int i = 0; i < N; ++i) new_y_[i] = y[i] + 0.5 * step * k_[0][i];
    if (!system_.rates(s + 0.5 * step, new_y_, k_[1])) return false;
    for (int i = 0; i < N; ++i) new_y_[i] = y[i] + 0.75 * step * k_[1][i];
    if (!system_.rates(s + 0.75 * step, new_y_, k_[2])) return false;
    for (int i = 0; i < N; ++i)
      new_y_[i] = y[i] + step * (2.0 / 9.0 * k_[0][i] + 1.0 / 3.0 * k_[1][i] + 4.0 / 9.0 * k_[2][i]);
    if (!system_.rates(s + step, new_y_, k_[3])) return false;
    T error[N];
    for (int i = 0; i < N; ++i)
      error[i] = step * (-5.0 / 72.0 * k_[0][i] + 1.0 / 12.0 * k_[1][i] + 1.0 / 9.0 * k_[2][i] - 0.125 * k_[3][i]);
    error_squared = system_.error_squared(new_y_, error);
    return value(error_squared) < 1e60;  // false for what is not a number
  }

  /// The next step over this one: 0.5 error^(-1/3) between 0.2 and `growth`.
  KOKKOS_INLINE_FUNCTION static T next_factor(const T& error_squared, double growth) {
    const double limit = 0.5 / growth, e = value(error_squared);
    if (e <= ::pow(limit, 6)) return T(growth);
    if (e >= ::pow(0.5 / 0.2, 6)) return T(0.2);
    return 0.5 * power(error_squared, -1.0 / 6.0);
  }

  const System& system_;
  T k_[4][N], new_y_[N];
};

}  // namespace mudline
