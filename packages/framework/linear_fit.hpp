#pragma once

#include <Kokkos_Core.hpp>

#include "tensor/small_lu.hpp"

namespace mudline {

/// Least squares fit of a quantity at the points of an element by a constant or by a linear function of the position.
/// Use: construct, add() every point, finish(); then solve() turns the sums of weight times terms() times quantity into
/// the coefficients of value().
template <int D>
struct LinearFit {
  static constexpr int most = D + 1;  // terms of a linear function
  int count = 1;                      // terms of the fit: 1 or most
  double origin[D] = {}, size = 1;    // [m] the terms are 1 and the distances from the origin over the size
  SmallLu<most> moments = {};

  KOKKOS_INLINE_FUNCTION void terms(const double (&x)[D], double (&t)[most]) const {
    t[0] = 1;
    for (int i = 0; i < D; ++i) t[1 + i] = count > 1 ? (x[i] - origin[i]) / size : 0.0;
  }
  KOKKOS_INLINE_FUNCTION void add(const double (&t)[most], double weight) {
    for (int k = 0; k < most; ++k)
      for (int l = 0; l < most; ++l) moments.a[k][l] += weight * t[k] * t[l];
  }
  /// False where the points do not determine the fit.
  KOKKOS_INLINE_FUNCTION bool finish() {
    for (int k = count; k < most; ++k) moments.a[k][k] = moments.a[0][0];
    return moments.factorise();
  }
  KOKKOS_INLINE_FUNCTION void solve(double (&sums)[most]) const { moments.solve(sums); }
  KOKKOS_INLINE_FUNCTION static double value(const double (&coefficients)[most], const double (&t)[most]) {
    double sum = 0;
    for (int k = 0; k < most; ++k) sum += coefficients[k] * t[k];
    return sum;
  }
};

}  // namespace mudline
