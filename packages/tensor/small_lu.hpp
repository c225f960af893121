#pragma once

#include <Kokkos_Macros.hpp>

#include <cmath>

namespace mudline {

/// Dense N x N factorisation with partial pivoting, in place.
template <int N>
struct SmallLu {
  double a[N][N];
  int row[N];

  KOKKOS_INLINE_FUNCTION bool factorise() {
    for (int k = 0; k < N; ++k) {
      int best = k;
      for (int i = k + 1; i < N; ++i)
        if (::fabs(a[i][k]) > ::fabs(a[best][k])) best = i;
      row[k] = best;
      if (!(::fabs(a[best][k]) > 1e-300)) return false;
      if (best != k)
        for (int j = 0; j < N; ++j) {
          const double swap = a[k][j];
          a[k][j] = a[best][j];
          a[best][j] = swap;
        }
      const double inverse = 1.0 / a[k][k];
      for (int i = k + 1; i < N; ++i) {
        const double factor = a[i][k] * inverse;
        a[i][k] = factor;
        if (factor != 0.0)
          for (int j = k + 1; j < N; ++j) a[i][j] -= factor * a[k][j];
      }
    }
    return true;
  }
  KOKKOS_INLINE_FUNCTION void solve(double* b) const {
    for (int k = 0; k < N; ++k) {
      const double swap = b[row[k]];
      b[row[k]] = b[k];
      b[k] = swap;
    }
    for (int i = 1; i < N; ++i)
      for (int j = 0; j < i; ++j) b[i] -= a[i][j] * b[j];
    for (int i = N - 1; i >= 0; --i) {
      for (int j = i + 1; j < N; ++j) b[i] -= a[i][j] * b[j];
      b[i] /= a[i][i];
    }
  }
};

}  // namespace mudline
