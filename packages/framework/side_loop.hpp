#pragma once

#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "discretisation/compiled_shapes.hpp"
#include "discretisation/side_map.hpp"
#include "framework/coordinates.hpp"
#include "framework/side_block.hpp"
#include "framework/tangent_kernel.hpp"
#include "framework/vector_scatter.hpp"

namespace mudline {

/// Input of a load law at a quadrature point of a side. T: double, or a dual number with derivatives with respect to
/// the position, the velocity and the scalar field there.
template <class C, class T>
struct SidePoint {
  static constexpr int D = C::dim;
  T x[D];         // [m]
  T normal[D];    // outward normal times the area per quadrature weight [m2]
  T area;         // length of `normal` [m2]; in plane strain per metre of depth
  T velocity[D];  // [m/s]
  T value;        // value of the scalar field
};

/// Output of a load law per quadrature weight: the load is the sum of weight * (force . w + flow q) over the points,
/// for the test functions w of the displacement or q of the scalar field.
template <class C, class T>
struct SideBalance {
  T force[C::dim];               // [N]
  T flow;                        // flow of the scalar's conjugate [1/s]
  double standing[C::dim] = {};  // part of the force that stood before the step [N]
};

/// Declares the dependencies of a load. A load law inherits this and overrides constants by the same names.
struct SideLaw {
  static constexpr bool flows = false;   // acts on a scalar field, not on the displacement
  static constexpr bool moves = false;   // depends on the position of the side
  static constexpr bool damps = false;   // depends on the velocity
  static constexpr bool drains = false;  // depends on the scalar field
};

/// The state on which a loop over sides works, and its sensitivities to the unknowns.
struct SideLevel {
  ConstCoordinateView x;  // [m]
  ConstNodalView velocity, value;
  double geometry_weight = 0;  // d x / d u_{n+1}
  double velocity_weight = 0, value_weight = 0;
};
inline SideLevel side_level(const StepView& view, const SideBlock& block, const ConstCoordinateView& x,
                            double geometry_weight = 0) {
  const Sensitivity& by = view.sensitivity[block.field];
  return {x, view.velocity, view.value, geometry_weight, by.velocity, by.value};
}

/// One generic loop over sides. A law is called once per quadrature point: law(row, point, out), with the row side *
/// points + q of the point's data. It is written once for numbers and for dual numbers. NN: nodes of a side, NF: nodes
/// of the scalar field on it.
template <class Coordinates, int NN, int NF>
struct SideLoop {
  static constexpr int D = Coordinates::dim, K = D - 1;
  SideBlock b;
  SideLevel at;

  template <class Law>
  struct Directions {
    static constexpr int x = Law::moves ? K * D : 0, velocity = x + (Law::moves ? D : 0),
                         value = velocity + (Law::damps ? D : 0), count = value + (Law::drains ? 1 : 0);
  };
  template <class Law>
  static constexpr int rows = Law::flows ? NF : D* NN;

  template <class Law, class T>
  KOKKOS_INLINE_FUNCTION SidePoint<Coordinates, T> point(int s, int q) const {
    using Index = Directions<Law>;
    SideMap<D, T> map;
    map.compute(NN, &b.shape.N(q, 0), &b.shape.dN(q, 0, 0), [&](int a, int i) { return at.x(b.nodes(s, a), i); });
    SidePoint<Coordinates, T> p;
    if constexpr (Law::moves && !std::is_same_v<T, double>) {
      for (int i = 0; i < D; ++i) {
        for (int k = 0; k < K; ++k) map.along[k][i].d[D * k + i] = 1;
        map.x[i].d[Index::x + i] = 1;
      }
      map.finish();
    }
    const T measure = Coordinates::measure(map.x.data());
    p.area = map.stretch * measure;
    p.value = T(0.0);
    for (int i = 0; i < D; ++i) {
      p.x[i] = map.x[i];
      p.normal[i] = map.normal[i] * measure;
      p.velocity[i] = T(0.0);
      if constexpr (Law::damps) {
        for (int a = 0; a < NN; ++a) p.velocity[i] += b.shape.N(q, a) * at.velocity(b.dofs(s, D * a + i));
        if constexpr (!std::is_same_v<T, double>) p.velocity[i].d[Index::velocity + i] = 1;
      }
    }
    if constexpr (Law::drains) {
      for (int c = 0; c < NF; ++c) p.value += b.partner.N(q, c) * at.value(b.dofs(s, c));
      if constexpr (!std::is_same_v<T, double>) p.value.d[Index::value] = 1;
    }
    return p;
  }

  /// Adds the load on side s to the residual point by point: a corner's shape function has both signs on a quadratic
  /// side, and sizes are taken before cancellation.
  template <class Law>
  KOKKOS_INLINE_FUNCTION void residual(int s, const Law& law, const VectorScatter& to) const {
    for (int q = 0; q < b.points; ++q) {
      SideBalance<Coordinates, double> out;
      law(s * b.points + q, point<Law, double>(s, q), out);
      for (int row = 0; row < rows<Law>; ++row) {
        double value, change;
        if constexpr (Law::flows) {
          value = change = b.shape.weights(q) * b.partner.N(q, row) * out.flow;
        } else {
          const double share = b.shape.weights(q) * b.shape.N(q, row / D);
          value = share * out.force[row % D];
          change = share * (out.force[row % D] - out.standing[row % D]);
        }
        to.add(s, row, value, std::abs(change), std::abs(value), q);
      }
    }
  }

  /// Adds weight times the derivative of residual() to the matrix.
  template <class Law>
  KOKKOS_INLINE_FUNCTION void tangent(int s, const Law& law, const MatrixScatter& to, double weight) const {
    using Index = Directions<Law>;
    using T = Dual<Index::count>;
    constexpr int n = rows<Law>;
    double k[n][n] = {};
    for (int q = 0; q < b.points; ++q) {
      SideBalance<Coordinates, T> out;
      law(s * b.points + q, point<Law, T>(s, q), out);
      for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column)
          k[row][column] += b.shape.weights(q) * entry<Law>(q, row, column, out);
    }
    to.add(s, 0, 0, k, weight);
  }

 private:
  template <class Law, class T>
  KOKKOS_INLINE_FUNCTION double entry(int q, int row, int column, const SideBalance<Coordinates, T>& out) const {
    using Index = Directions<Law>;
    if constexpr (Law::flows) {
      return b.partner.N(q, row) * out.flow.d[Index::value] * at.value_weight * b.partner.N(q, column);
    } else {
      const T& force = out.force[row % D];
      const int node = column / D, j = column % D;
      double sum = 0;
      if constexpr (Law::moves) {
        double moved = force.d[Index::x + j] * b.shape.N(q, node);
        for (int k = 0; k < K; ++k) moved += force.d[D * k + j] * b.shape.dN(q, node, k);
        sum += moved * at.geometry_weight;
      }
      if constexpr (Law::damps) sum += force.d[Index::velocity + j] * b.shape.N(q, node) * at.velocity_weight;
      return b.shape.N(q, row / D) * sum;
    }
  }
};

/// Kernel for one side: adds its load to the residual.
template <class Loop, class Law>
struct SideResidual {
  Loop loop;
  Law law;
  VectorScatter to;
  KOKKOS_INLINE_FUNCTION void operator()(int s) const {
    to.open(s);
    loop.residual(s, law, to);
  }
};
template <class Loop, class Law>
SideResidual(Loop, Law, VectorScatter) -> SideResidual<Loop, Law>;

/// Calls f(loop) with the loop that fits a block's sides.
template <class F>
void with_side_loop(Geometry geometry, const SideBlock& b, const SideLevel& level, F&& f) {
  with_coordinates(geometry, [&](auto coordinates) {
    using C = decltype(coordinates);
    using Sides = std::conditional_t<C::dim == 3, SpaceSides, PlaneSides>;
    with_node_counts<void>(Sides{}, b.shape.nodes, [&](auto counts) {  // the corners may be the field's only nodes
      constexpr int N = decltype(counts)::nodes, P = decltype(counts)::corners;
      if (b.partner.nodes == N)
        f(SideLoop<C, N, N>{b, level});
      else
        f(SideLoop<C, N, P>{b, level});
    });
  });
}

/// Adds a load on all sides of a block to the residual.
template <class Law>
void add_side_residual(Geometry geometry, const SideBlock& block, const SideLevel& level, const Law& law,
                       const ResidualView& f) {
  with_side_loop(geometry, block, level, [&](const auto& loop) {
    in_order("residual rows", block.rows, 0, block.sides, VectorScatter{f, block.dofs, block.points},
             [&](int first, int last, const VectorScatter& to) {
               Kokkos::parallel_for("side residual", Kokkos::RangePolicy<>(first, last), SideResidual{loop, law, to});
             });
  });
}

/// Adds weight times the derivative of a load on all sides of a block to the matrix.
template <class Law>
void add_side_tangent(Geometry geometry, const SideBlock& block, const SideLevel& level, const Law& law,
                      const MatrixScatter& to, double weight) {
  with_side_loop(geometry, block, level, [&](const auto& loop) {
    add_tangents("side tangent", block.rows, 0, block.sides, loop, law, to, weight);
  });
}

}  // namespace mudline
