#pragma once

// Small pieces that every element kernel shares: gather, geometry at a quadrature point, scatter.

#include <Kokkos_Core.hpp>

#include <stdexcept>

#include "algebra/assembler.hpp"
#include "discretisation/mesh.hpp"
#include "physics/term.hpp"

namespace mudline {

/// Compile-time sizes of an element: nodes of the displacement field and of its linear partner (0: no second field).
template <int NU_, int NP_>
struct ElementPair {
  static constexpr int NU = NU_, NP = NP_;
};

/// Calls f(ElementPair<...>) for the shape; `partner`: with the linear partner field.
template <class F>
auto dispatch_pair(CellShape shape, bool partner, F&& f) {
  switch (shape) {
    case CellShape::tri6:
      return partner ? f(ElementPair<6, 3>{}) : f(ElementPair<6, 0>{});
    case CellShape::quad9:
      return partner ? f(ElementPair<9, 4>{}) : f(ElementPair<9, 0>{});
    case CellShape::tri3:
      if (!partner) return f(ElementPair<3, 0>{});
      break;
    case CellShape::quad4:
      if (!partner) return f(ElementPair<4, 0>{});
      break;
  }
  throw std::logic_error("no inf-sup stable pair on a linear cell");
}

/// Shape gradients and measure at one quadrature point of one configuration.
template <int N>
struct PointGeometry {
  double g[N][2];  // dN/dx [1/m]
  double det;      // of the reference map [m2]
  double r;        // radius [m]; 1/(2 pi) in plane strain, so that measure is uniform
  bool ok;         // det > 0

  KOKKOS_INLINE_FUNCTION void compute(const double (&x)[N][2], const double* dN, const double* shape,
                                      bool axisymmetric) {
    double j00 = 0, j01 = 0, j10 = 0, j11 = 0, radius = 0;
    for (int a = 0; a < N; ++a) {
      j00 += x[a][0] * dN[2 * a];
      j01 += x[a][0] * dN[2 * a + 1];
      j10 += x[a][1] * dN[2 * a];
      j11 += x[a][1] * dN[2 * a + 1];
      radius += shape[a] * x[a][0];
    }
    det = j00 * j11 - j01 * j10;
    r = axisymmetric ? radius : 1.0 / (2 * 3.14159265358979323846);
    ok = det > 0 && r > 0;
    const double inverse = ok ? 1.0 / det : 0.0;
    for (int a = 0; a < N; ++a) {
      g[a][0] = (j11 * dN[2 * a] - j10 * dN[2 * a + 1]) * inverse;
      g[a][1] = (-j01 * dN[2 * a] + j00 * dN[2 * a + 1]) * inverse;
    }
  }
  /// Volume per unit weight: det, times 2 pi r in axisymmetry.
  KOKKOS_INLINE_FUNCTION double volume(double weight) const { return weight * det * 2 * 3.14159265358979323846 * r; }
};

/// Nodal coordinates of one element.
template <int N>
KOKKOS_INLINE_FUNCTION void gather(const Kokkos::View<int**, Kokkos::LayoutRight>& nodes, int e,
                                   const ConstCoordinateView& from, double (&x)[N][2]) {
  for (int a = 0; a < N; ++a) {
    const int node = nodes(e, a);
    x[a][0] = from(node, 0);
    x[a][1] = from(node, 1);
  }
}

/// Displacement of one element's nodes between two states; its columns come first among the element's dofs.
template <int N>
KOKKOS_INLINE_FUNCTION void gather_increment(const ElementDofs& dofs, int e, const ConstNodalView& from,
                                             const ConstNodalView& to, double (&du)[N][2]) {
  for (int a = 0; a < N; ++a)
    for (int i = 0; i < 2; ++i) {
      const int dof = dofs(e, 2 * a + i);
      du[a][i] = to(dof) - from(dof);
    }
}

/// Gathers `N` values starting at column `first` of the element's dofs.
template <int N>
KOKKOS_INLINE_FUNCTION void gather(const ElementDofs& dofs, int e, int first, const ConstNodalView& from,
                                   double (&v)[N]) {
  for (int a = 0; a < N; ++a) v[a] = from(dofs(e, first + a));
}

/// Adds an element vector that starts at row `first` of the element's dofs and acts in the step as a whole.
template <int N>
KOKKOS_INLINE_FUNCTION void scatter_vector(const ElementDofs& dofs, int e, int first, const double (&v)[N],
                                           const ResidualView& f) {
  for (int a = 0; a < N; ++a) f.add(dofs(e, first + a), v[a]);
}

/// The same of an element vector of which `change`, of either sign, acts in the step.
template <int N>
KOKKOS_INLINE_FUNCTION void scatter_vector(const ElementDofs& dofs, int e, int first, const double (&v)[N],
                                           const double (&change)[N], const ResidualView& f) {
  for (int a = 0; a < N; ++a) f.add(dofs(e, first + a), v[a], change[a]);
}

/// Adds an element matrix whose rows and columns start at row0, col0 of the element's dofs.
template <int R, int C>
KOKKOS_INLINE_FUNCTION void scatter_matrix(const MatrixScatter& to, int e, int row0, int col0, const double (&k)[R][C],
                                           double weight) {
  bool fixed_column[C];
  for (int b = 0; b < C; ++b) fixed_column[b] = to.constrained(to.dofs(e, col0 + b));
  for (int a = 0; a < R; ++a) {
    const bool fixed_row = to.constrained(to.dofs(e, row0 + a));
    for (int b = 0; b < C; ++b) {
      if ((fixed_row || fixed_column[b]) && row0 + a != col0 + b) continue;
      MatrixScatter::accumulate(&to.values(to.offsets(e, row0 + a, col0 + b)), weight * k[a][b]);
    }
  }
}

}  // namespace mudline
