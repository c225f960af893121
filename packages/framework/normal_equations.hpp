#pragma once

#include <cstddef>
#include <vector>

namespace mudline {

/// Solves the normal equations of a least squares fit for all columns; b: (column, n), in: right sides, out: solutions.
/// A direction that the samples do not resolve (they lie on a conic) is left out: its coefficient is zero. Returns
/// how many were resolved.
template <int n>
int solve_normal(double (&a)[n][n], std::vector<double>& b) {
  double diagonal[n];
  for (int k = 0; k < n; ++k) diagonal[k] = a[k][k];
  bool out[n];
  int resolved = 0;
  for (int k = 0; k < n; ++k) {
    out[k] = a[k][k] <= 1e-8 * diagonal[k];
    if (out[k]) {
      for (std::size_t c = 0; c < b.size(); c += n) b[c + k] = 0;
      continue;
    }
    ++resolved;
    for (int i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (int j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
      for (std::size_t c = 0; c < b.size(); c += n) b[c + i] -= factor * b[c + k];
    }
  }
  for (std::size_t c = 0; c < b.size(); c += n)
    for (int k = n - 1; k >= 0; --k) {
      if (out[k]) continue;
      for (int j = k + 1; j < n; ++j) b[c + k] -= out[j] ? 0.0 : a[k][j] * b[c + j];
      b[c + k] /= a[k][k];
    }
  return resolved;
}

}  // namespace mudline
