#pragma once

#include "discretisation/cells/cell.hpp"

namespace mudline {

/// Shape functions of a triangle or tetrahedron: the barycentric coordinates L of the corners, or products of two of
/// them.
template <int Dim>
void evaluate_simplex(const Cell& own, const double* xi, double* N, double* dN) {
  double L[Dim + 1], dL[Dim + 1][Dim];
  L[0] = 1;
  for (int d = 0; d < Dim; ++d) L[0] -= xi[d];
  for (int i = 1; i <= Dim; ++i) L[i] = xi[i - 1];
  for (int i = 0; i <= Dim; ++i)
    for (int d = 0; d < Dim; ++d) dL[i][d] = i == 0 ? -1 : (i == d + 1 ? 1 : 0);
  for (int i = 0; i <= Dim; ++i) {
    N[i] = own.order == 1 ? L[i] : L[i] * (2 * L[i] - 1);
    for (int d = 0; d < Dim; ++d) dN[Dim * i + d] = own.order == 1 ? dL[i][d] : (4 * L[i] - 1) * dL[i][d];
  }
  if (own.order == 1) return;
  int a = own.corners;
  for (const auto& [i, j] : own.edges) {
    N[a] = 4 * L[i] * L[j];
    for (int d = 0; d < Dim; ++d) dN[Dim * a + d] = 4 * (dL[i][d] * L[j] + L[i] * dL[j][d]);
    ++a;
  }
}

/// Shape functions that are products of line shapes.
template <int Dim>
void evaluate_grid(const Cell& own, const double* xi, double* N, double* dN) {
  double value[Dim][3], slope[Dim][3];
  for (int d = 0; d < Dim; ++d) evaluate_line(own.order + 1, xi[d], value[d], slope[d]);
  const int nodes = static_cast<int>(own.grid.size());
  for (int a = 0; a < nodes; ++a) {
    const std::array<int, 3>& place = own.grid[a];
    N[a] = 1;
    for (int d = 0; d < Dim; ++d) N[a] *= value[d][place[d]];
    for (int k = 0; k < Dim; ++k) {
      dN[Dim * a + k] = 1;
      for (int d = 0; d < Dim; ++d) dN[Dim * a + k] *= (d == k ? slope : value)[d][place[d]];
    }
  }
}

}  // namespace mudline
