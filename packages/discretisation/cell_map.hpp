#pragma once

#include "tensor/mat.hpp"

namespace mudline {

/// The isoparametric map of a cell at one point: x = sum_a N_a(xi) x_a.
template <int Dim>
struct CellMap {
  Mat<double, Dim> slope;    // dx_i / dxi_k [m]
  Mat<double, Dim> inverse;  // dxi_k / dx_i [1/m]; not finite where det is 0
  double det;                // of `slope` [m^Dim]; not positive in a folded cell

  /// x: places of the nodes (node, i) [m]; dN: reference gradients of their shapes (node, k), row-major.
  template <int N>
  KOKKOS_INLINE_FUNCTION void compute(const double (&x)[N][Dim], const double* dN) {
    for (int i = 0; i < Dim; ++i)
      for (int k = 0; k < Dim; ++k) slope[i][k] = 0;
    for (int a = 0; a < N; ++a)
      for (int i = 0; i < Dim; ++i)
        for (int k = 0; k < Dim; ++k) slope[i][k] += x[a][i] * dN[Dim * a + k];
    finish();
  }
  /// From the gradient itself.
  KOKKOS_INLINE_FUNCTION void compute(const Mat<double, Dim>& gradient) {
    for (int i = 0; i < Dim; ++i)
      for (int k = 0; k < Dim; ++k) slope[i][k] = gradient[i][k];
    finish();
  }
  /// Gradients in space [1/m] of shapes whose reference gradients are given: its own, or those of another field.
  template <int N>
  KOKKOS_INLINE_FUNCTION void gradients(const double* dN, double (&g)[N][Dim]) const {
    for (int a = 0; a < N; ++a)
      for (int i = 0; i < Dim; ++i) {
        double sum = 0;
        for (int k = 0; k < Dim; ++k) sum += dN[Dim * a + k] * inverse[k][i];
        g[a][i] = sum;
      }
  }

 private:
  KOKKOS_INLINE_FUNCTION void finish() {
    det = determinant(slope);
    invert(slope, det, inverse);
  }
};

}  // namespace mudline
