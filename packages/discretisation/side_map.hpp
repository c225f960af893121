#pragma once

#include "tensor/vec.hpp"

namespace mudline {

/// The isoparametric map of a side, a surface of Dim - 1 parameters, at one point: x = sum_a N_a(xi) x_a. T: double, or
/// a dual number that carries derivatives with respect to whatever the node positions depend on.
template <int Dim, class T = double>
struct SideMap {
  Vec<T, Dim> x;               // [m]
  Vec<T, Dim> along[Dim - 1];  // dx / dxi_k [m]
  Vec<T, Dim> normal;          // outward normal of length `stretch`
  T stretch;                   // area per reference area [m^(Dim-1)]; 0 where the side has no extent

  /// place(a, i): coordinate i of node a [m]; N: shape functions (node); dN: their reference gradients (node, k),
  /// row-major; both are dual numbers where the reference coordinates of the point carry derivatives too.
  template <class S, class Place>
  KOKKOS_INLINE_FUNCTION void compute(int nodes, const S* N, const S* dN, Place&& place) {
    for (int i = 0; i < Dim; ++i) {
      x[i] = T(0.0);
      for (int k = 0; k < Dim - 1; ++k) along[k][i] = T(0.0);
      for (int a = 0; a < nodes; ++a) {
        const T at = place(a, i);
        x[i] += N[a] * at;
        for (int k = 0; k < Dim - 1; ++k) along[k][i] += dN[(Dim - 1) * a + k] * at;
      }
    }
    finish();
  }

  /// Normal and stretch from `along`. Corners go round counter-clockwise as seen from outside; in the plane the outward
  /// normal is to the right of the tangent `along`.
  KOKKOS_INLINE_FUNCTION void finish() {
    static_assert(Dim == 2 || Dim == 3);
    if constexpr (Dim == 2) {
      normal[0] = along[0][1];
      normal[1] = -along[0][0];
    } else {
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        normal[i] = along[0][j] * along[1][k] - along[0][k] * along[1][j];
      }
    }
    T square = normal[0] * normal[0];
    for (int i = 1; i < Dim; ++i) square += normal[i] * normal[i];
    stretch = square_root(square);
  }
};

}  // namespace mudline
