#pragma once

#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "discretisation/cell_map.hpp"
#include "framework/element_shapes.hpp"
#include "framework/fitted_dilatation.hpp"
#include "framework/point_tangent.hpp"
#include "framework/tangent_kernel.hpp"
#include "framework/vector_scatter.hpp"
#include "tensor/mat.hpp"

// g++ completely unrolls a short loop before it tries to vectorise it, which prevents vectorisation. With a number it
// vectorises first and then takes so many vectors at a time.
#if defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__)
#define MUDLINE_VECTOR_LOOP _Pragma("GCC unroll 4")
#else
#define MUDLINE_VECTOR_LOOP
#endif

namespace mudline {

/// One generic loop over the elements of a block. A law is called once per quadrature point: law(row, fields, out),
/// with the row of the point's data, PointFields and PointBalance. It is written once for numbers and dual numbers;
/// derivatives come by automatic differentiation.
template <class Coordinates, class Shapes>
struct ElementLoop {
  static constexpr int D = Coordinates::dim, NU = Shapes::NU, NS = Shapes::NS, S = Shapes::S;
  static constexpr int NQ = NS > 0 ? NS : 1, SQ = S > 0 ? S : 1;  // sizes of arrays that may be empty
  static constexpr bool moves = Shapes::moves, hoop = Coordinates::hoop;
  static constexpr int MU = moves ? D * NU : 0, columns = MU + S * NS;  // number of unknowns: displacement, all
  template <class Law>
  using Directions = LawDirections<Coordinates, S, Law>;
  template <class Law>
  using Rows = LawRows<Coordinates, S, Law>;
  template <class Law>
  static constexpr bool gradients = Law::gradients || Law::fluxes;  // whether a law needs those of scalar fields
  static constexpr bool may_fit = moves && S == 0;                  // whether stresses may see a fitted volume strain
  using Fields = PointFields<Coordinates, S, double>;
  using Balance = PointBalance<Coordinates, S, double>;

  FieldBlock b;
  LoopLevel at;

  /// Coordinates and values at the nodes of one element.
  struct Nodes {
    double x[NU][D], moved[NU][D];  // [m] position at the level; displacement in the step, without rounding of x
    double rate[NU][D], acceleration[NU][D];
    double value[SQ][NQ], change[SQ][NQ], scalar_rate[SQ][NQ];
    // Water flows as if an open vertex had the pressure outside, so that its own pressure drives no flow, and what
    // flows into it passes.
    double driving[SQ][NQ];
    bool open[SQ][NQ];
  };
  /// The shapes at one point.
  struct Shape {
    const double *N, *Np;
    double g[NU][D], h[NU], gp[NQ][D];  // gradients [1/m]; N / r in axial symmetry
    double dv;                          // [m3]
  };

  // gather() and shapes() are called, not inlined: all laws share them, and it takes a third off the time to compile.
  template <bool Rates>
  [[gnu::noinline]] KOKKOS_FUNCTION void gather(int e, Nodes& n) const {
    for (int a = 0; a < NU; ++a)
      for (int i = 0; i < D; ++i) {
        n.x[a][i] = at.x(b.nodes(e, a), i);
        const int dof = moves ? b.dofs(e, D * a + i) : 0;
        n.moved[a][i] = moves ? at.geometry_weight * (at.value_end(dof) - at.value_old(dof)) : 0.0;
        if constexpr (Rates) {
          n.rate[a][i] = moves ? at.rate(dof) : 0.0;
          n.acceleration[a][i] = moves ? at.acceleration(dof) : 0.0;
        }
      }
    for (int s = 0; s < S; ++s)
      for (int c = 0; c < NS; ++c) {
        const int dof = b.dofs(e, MU + s * NS + c);
        n.value[s][c] = at.value(dof);
        n.change[s][c] = at.value(dof) - at.value_old(dof);
        n.open[s][c] = at.open.extent(0) > 0 && at.open(dof);
        n.driving[s][c] = n.open[s][c] ? at.outside(dof) : n.value[s][c];
        if constexpr (Rates) n.scalar_rate[s][c] = at.rate(dof);
      }
  }

  /// Shapes at a quadrature point; false where the element is folded or on the wrong side of the axis. Gradients:
  /// whether those of the scalar fields are needed; else they are undefined.
  template <bool Gradients>
  [[gnu::noinline]] KOKKOS_FUNCTION bool shapes(int q, const double (&x)[NU][D], Shape& s) const {
    s.N = &b.u.N(q, 0);
    s.Np = NS > 0 ? &b.p.N(q, 0) : nullptr;
    CellMap<D> map;
    map.compute(x, &b.u.dN(q, 0, 0));
    double here[D] = {};  // the position matters in axial symmetry only
    if constexpr (Coordinates::hoop)
      for (int a = 0; a < NU; ++a) here[0] += s.N[a] * x[a][0];
    const double measure = Coordinates::measure(here);
    if (!(map.det > 0) || !(measure > 0)) return false;
    map.gradients(&b.u.dN(q, 0, 0), s.g);
    if constexpr (Gradients && NS > 0) map.gradients(&b.p.dN(q, 0, 0), s.gp);
    for (int a = 0; a < NU; ++a) s.h[a] = Coordinates::hoop ? s.N[a] / here[0] : 0.0;
    s.dv = b.u.weights(q) * map.det * measure;
    return true;
  }
  /// The fields at a point with known shapes; false where the element would be folded at the start of the step.
  template <bool Rates, bool Gradients>
  KOKKOS_INLINE_FUNCTION bool fields(const Nodes& n, const Shape& s, Fields& f) const {
    f.hoop_moved = 0;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) f.moved[i][j] = 0;
    for (int a = 0; a < NU; ++a) {
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j) f.moved[i][j] += n.moved[a][i] * s.g[a][j];
      f.hoop_moved += s.h[a] * n.moved[a][0];
    }
    if constexpr (Rates) {
      f.hoop_rate = 0;
      for (int i = 0; i < D; ++i) {
        f.velocity[i] = f.acceleration[i] = 0;
        for (int j = 0; j < D; ++j) f.velocity_gradient[i][j] = 0;
      }
      for (int a = 0; a < NU; ++a) {
        for (int i = 0; i < D; ++i) {
          f.velocity[i] += s.N[a] * n.rate[a][i];
          f.acceleration[i] += s.N[a] * n.acceleration[a][i];
          for (int j = 0; j < D; ++j) f.velocity_gradient[i][j] += n.rate[a][i] * s.g[a][j];
        }
        f.hoop_rate += s.h[a] * n.rate[a][0];
      }
    }
    Mat<double, D> back;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) back[i][j] = (i == j ? 1.0 : 0.0) - f.moved[i][j];
    const double ratio = determinant(back) * (1 - f.hoop_moved);
    if (!(ratio > 0)) return false;
    f.volume_ratio = 1 / ratio;
    for (int k = 0; k < S; ++k) {
      f.value[k] = f.change[k] = 0;
      if constexpr (Rates) f.rate[k] = 0;
      if constexpr (Gradients)
        for (int j = 0; j < D; ++j) f.gradient[k][j] = 0;
      for (int c = 0; c < NS; ++c) {
        f.value[k] += s.Np[c] * n.value[k][c];
        f.change[k] += s.Np[c] * n.change[k][c];
        if constexpr (Rates) f.rate[k] += s.Np[c] * n.scalar_rate[k][c];
        if constexpr (Gradients)
          for (int j = 0; j < D; ++j) f.gradient[k][j] += s.gp[c][j] * n.driving[k][c];
      }
    }
    return true;
  }

  /// Calls f(point, shape, fields) for the points of an element; stops and returns 1 where it is folded. Rates,
  /// Gradients: whether rates, and gradients of scalar fields, are needed; else they are undefined. Strains: whether
  /// the fields are those that stresses see.
  template <bool Rates, bool Gradients, bool Strains = false, class F>
  KOKKOS_INLINE_FUNCTION int for_each_point(int e, F&& f) const {
    Nodes n;
    gather<Rates>(e, n);
    constexpr bool may = may_fit && Strains;
    [[maybe_unused]] std::conditional_t<may, FittedDilatation<ElementLoop>, int> fitted;
    if constexpr (may)
      if (b.dilatation_terms > 0 && !fitted.template find<Rates>(*this, n)) return 1;
    for (int q = 0; q < b.points; ++q) {
      Shape s;
      Fields here;
      if (!shapes<Gradients>(q, n.x, s) || !fields<Rates, Gradients>(n, s, here)) return 1;
      if constexpr (may)
        if (b.dilatation_terms > 0 && !fitted.template replace<Rates>(n, s, here)) return 1;
      f(q, s, here);
    }
    return 0;
  }

  /// Adds the balance of element e to the residual; returns 1 where the element is folded. The acting size is the sum
  /// of the sizes of each kind of contribution, because kinds may cancel each other, as storage and flow do in
  /// consolidation.
  template <class Law>
  KOKKOS_INLINE_FUNCTION int residual(int e, const Law& law, const VectorScatter& to) const {
    Nodes n;
    gather<Law::rates>(e, n);
    double r[NU][D] = {}, acting[NU][D] = {}, skeleton[NU][D] = {}, fluid[NU][D] = {};
    double stored[SQ][NQ] = {}, flown[SQ][NQ] = {}, cancelled[SQ][NQ] = {};
    constexpr bool may = may_fit && Law::stresses;
    [[maybe_unused]] std::conditional_t<may, FittedDilatation<ElementLoop>, int> fitted;
    if constexpr (may)
      if (b.dilatation_terms > 0 && !fitted.template find<Law::rates>(*this, n)) return 1;
    for (int q = 0; q < b.points; ++q) {
      Shape s;
      Fields f;
      Balance out;
      if (!shapes<gradients<Law>>(q, n.x, s) || !fields<Law::rates, gradients<Law>>(n, s, f)) return 1;
      if constexpr (may)
        if (b.dilatation_terms > 0 && !fitted.template replace<Law::rates>(n, s, f)) return 1;
      law(e * b.points + q, f, out);
      for (int a = 0; a < NU; ++a)
        for (int i = 0; i < D; ++i) {
          double sum = 0, acts = 0;
          if constexpr (Law::forces) {
            sum = s.N[a] * out.force[i];
            acts = sum - s.N[a] * out.standing_force[i];
          }
          if constexpr (Law::stresses) {
            const double work = work_of(s, a, i, out.stress, out.hoop_stress);
            sum += work;
            if constexpr (Law::stands) {
              skeleton[a][i] += s.dv * work_of(s, a, i, out.stress_change, out.hoop_change);
              fluid[a][i] += s.dv * out.pressure_change * (s.g[a][i] + (i == 0 ? s.h[a] : 0.0));
            } else {
              acts += work;
            }
          }
          r[a][i] += s.dv * sum;
          acting[a][i] += s.dv * acts;
        }
      for (int k = 0; k < S; ++k)
        for (int c = 0; c < NS; ++c) {
          if constexpr (Law::storages) stored[k][c] += s.dv * s.Np[c] * out.storage[k];
          if constexpr (Law::cancels) cancelled[k][c] += s.dv * std::abs(s.Np[c]) * out.cancelled[k];
          if constexpr (Law::fluxes)
            for (int j = 0; j < D; ++j) flown[k][c] += s.dv * s.gp[c][j] * out.flux[k][j];
        }
    }
    if constexpr (Law::forces || Law::stresses)
      for (int a = 0; a < NU; ++a)
        for (int i = 0; i < D; ++i) {
          const double acts = std::abs(acting[a][i]) + std::abs(skeleton[a][i]) + std::abs(fluid[a][i]);
          to.add(e, D * a + i, r[a][i], acts, std::abs(r[a][i]));
        }
    if constexpr (Law::storages || Law::fluxes)
      for (int k = 0; k < S; ++k)
        for (int c = 0; c < NS; ++c) {
          if (n.open[k][c]) {
            to.pass(e, MU + k * NS + c, flown[k][c]);
            flown[k][c] = 0;
          }
          const double sum = stored[k][c] + flown[k][c];
          to.add(e, MU + k * NS + c, sum, std::abs(stored[k][c]) + std::abs(flown[k][c]),
                 std::abs(sum) + cancelled[k][c]);
        }
    return 0;
  }

  /// Work of a stress on a unit displacement of node a in direction i, per volume.
  KOKKOS_INLINE_FUNCTION static double work_of(const Shape& s, int a, int i, const Mat<double, D>& stress,
                                               double hoop_stress) {
    double work = Coordinates::hoop && i == 0 ? hoop_stress * s.h[a] : 0.0;
    for (int j = 0; j < D; ++j) work += stress[i][j] * s.g[a][j];
    return work;
  }

  /// Columns of the element's matrix that a law fills.
  template <class Law>
  struct Columns {
    static constexpr int first = Law::motion || Law::inertia ? 0 : MU,
                         last = Law::scalars || Law::gradients ? columns : MU, count = last - first;
  };

  /// Converts derivative indices to the nodes' unknowns: (row, column).
  template <class Law>
  KOKKOS_INLINE_FUNCTION static void to_unknowns(const Nodes& n, const Shape& s,
                                                 const double (&A)[Rows<Law>::count][Directions<Law>::count],
                                                 double (&Y)[Rows<Law>::count][Columns<Law>::count]) {
    using Index = Directions<Law>;
    for (int row = 0; row < Rows<Law>::count; ++row) {
      double* y = Y[row];
      if constexpr (Law::motion || Law::inertia)
        for (int a = 0; a < NU; ++a)
          for (int j = 0; j < D; ++j) {
            double sum = 0;
            if constexpr (Law::motion && Law::shape) {
              for (int m = 0; m < D; ++m) sum += A[row][D * j + m] * s.g[a][m];
              if constexpr (Coordinates::hoop)
                if (j == 0) sum += A[row][Index::hoop] * s.h[a];
            } else if constexpr (Law::motion) {
              sum += A[row][Index::motion] * (s.g[a][j] + (j == 0 ? s.h[a] : 0.0));
            }
            if constexpr (Law::inertia) sum += A[row][Index::inertia + j] * s.N[a];
            *y++ = sum;
          }
      if constexpr (Law::scalars || Law::gradients)
        for (int k = 0; k < S; ++k)
          for (int c = 0; c < NS; ++c) {
            double sum = 0;
            if constexpr (Law::scalars) sum += A[row][Index::value + k] * s.Np[c];
            if constexpr (Law::gradients)
              for (int m = 0; m < D && !n.open[k][c]; ++m) sum += A[row][Index::gradient + D * k + m] * s.gp[c][m];
            *y++ = sum;
          }
    }
  }

  /// Adds a point's rows to the rows of the element by the test functions' values and gradients.
  template <class Law>
  KOKKOS_INLINE_FUNCTION static void spread(const Nodes& n, const Shape& s,
                                            const double (&Y)[Rows<Law>::count][Columns<Law>::count],
                                            double (&ku)[D * NU][Columns<Law>::count],
                                            double (&kp)[SQ * NQ][Columns<Law>::count]) {
    using Row = Rows<Law>;
    constexpr int width = Columns<Law>::count;
    if constexpr (Law::forces || Law::stresses)
      for (int i = 0; i < D; ++i)
        for (int a = 0; a < NU; ++a) {
          MUDLINE_VECTOR_LOOP
          for (int c = 0; c < width; ++c) {
            double sum = ku[D * a + i][c];
            if constexpr (Law::forces) sum += s.N[a] * Y[Row::force + i][c];
            if constexpr (Law::stresses) {
              for (int l = 0; l < D; ++l) sum += s.g[a][l] * Y[Row::stress + D * i + l][c];
              if constexpr (Coordinates::hoop)
                if (i == 0) sum += s.h[a] * Y[Row::hoop][c];
            }
            ku[D * a + i][c] = sum;
          }
        }
    if constexpr (Law::storages || Law::fluxes)
      for (int k = 0; k < S; ++k)
        for (int r = 0; r < NS; ++r) {
          const double inner = n.open[k][r] ? 0.0 : 1.0;
          MUDLINE_VECTOR_LOOP
          for (int c = 0; c < width; ++c) {
            double sum = kp[NS * k + r][c];
            if constexpr (Law::storages) sum += s.Np[r] * Y[Row::storage + k][c];
            if constexpr (Law::fluxes)
              for (int l = 0; l < D; ++l) sum += inner * s.gp[r][l] * Y[Row::flux + D * k + l][c];
            kp[NS * k + r][c] = sum;
          }
        }
  }

  /// Adds weight times the derivative of residual() to the matrix.
  template <class Law>
  KOKKOS_INLINE_FUNCTION void tangent(int e, const Law& law, const MatrixScatter& to, double weight) const {
    constexpr int width = Columns<Law>::count, first = Columns<Law>::first;
    Nodes n;
    gather<Law::rates>(e, n);
    double ku[D * NU][width] = {}, kp[SQ * NQ][width] = {};
    constexpr bool may = may_fit && Law::stresses && Law::motion;
    [[maybe_unused]] std::conditional_t<may, FittedDilatation<ElementLoop>, int> fitted;
    if constexpr (may)
      if (b.dilatation_terms > 0) {
        if (!fitted.template find<Law::rates>(*this, n)) return;
        fitted.find_unit(*this, n);
      }
    for (int q = 0; q < b.points; ++q) {
      Shape s;
      Fields f;
      if (!shapes<gradients<Law>>(q, n.x, s) || !fields<Law::rates, gradients<Law>>(n, s, f)) return;
      if constexpr (may)
        if (b.dilatation_terms > 0 && !fitted.template replace<Law::rates>(n, s, f)) return;
      double A[Rows<Law>::count][Directions<Law>::count], Y[Rows<Law>::count][width];
      PointTangent<Coordinates, S, Law>{at}(e * b.points + q, law, s.dv, f, A);
      to_unknowns<Law>(n, s, A, Y);
      if constexpr (may)
        if (b.dilatation_terms > 0) {
          Balance out;
          law(e * b.points + q, f, out);
          fitted.template follow<Rows<Law>>(n, s, out, at.geometry_weight, A, Y);
        }
      spread<Law>(n, s, Y, ku, kp);
    }
    if constexpr (Law::forces || Law::stresses) to.add(e, 0, first, ku, weight);
    if constexpr (Law::storages || Law::fluxes) to.add(e, MU, first, kp, weight);
  }
};

/// Whether a law fits a set of fields: a scalar balance needs a scalar field, a force balance needs the displacement.
template <class Law, class Shapes>
constexpr bool fits = (Law::fields == PointLaw::any || Law::fields == Shapes::S) &&
                      (Shapes::S > 0 || !(Law::storages || Law::fluxes)) &&
                      (Shapes::moves || !(Law::forces || Law::stresses || Law::motion || Law::inertia));
[[noreturn]] inline void fail_to_fit() {
  throw std::logic_error("a law of balance does not fit the fields of its block");
}

/// Kernel for one element: adds its balance to the residual; `failed` counts folded elements.
template <class Loop, class Law>
struct ElementResidual {
  Loop loop;
  Law law;
  VectorScatter to;
  KOKKOS_INLINE_FUNCTION void operator()(int e, int& failed) const {
    to.open(e);
    failed += loop.residual(e, law, to);
  }
};
template <class Loop, class Law>
ElementResidual(Loop, Law, VectorScatter) -> ElementResidual<Loop, Law>;

/// Calls f(loop) with the element loop that a law needs on a block.
template <class Law, class F>
void with_loop(Geometry geometry, const FieldBlock& block, const LoopLevel& level, F&& f) {
  constexpr bool uses_scalars = Law::scalars || Law::gradients || Law::storages || Law::fluxes;
  with_element<uses_scalars ? max_scalars : 0>(geometry, block, [&](auto coordinates, auto shapes) {
    if constexpr (fits<Law, decltype(shapes)>)
      f(ElementLoop<decltype(coordinates), decltype(shapes)>{block, level});
    else
      fail_to_fit();
  });
}

/// Adds the balance of a block's elements to the residual. `level`: the state to be used. Returns the number of folded
/// elements.
template <class Law>
int add_residual(Geometry geometry, const FieldBlock& block, const LoopLevel& level, const Law& law,
                 const ResidualView& f) {
  int failed = 0;
  with_loop<Law>(geometry, block, level, [&](const auto& loop) {
    in_order("residual rows", block.rows, 0, block.elements, VectorScatter{f, block.dofs},
             [&](int first, int last, const VectorScatter& to) {
               int folded = 0;
               Kokkos::parallel_reduce("residual", Kokkos::RangePolicy<>(first, last), ElementResidual{loop, law, to},
                                       folded);
               failed += folded;
             });
  });
  return failed;
}

/// Adds weight times the derivative for elements [first, last); `first` is the start of a batch.
template <class Law>
void add_tangent(Geometry geometry, const FieldBlock& block, const LoopLevel& level, const Law& law,
                 const MatrixScatter& to, double weight, int first, int last) {
  with_loop<Law>(geometry, block, level,
                 [&](const auto& loop) { add_tangents("tangent", block.rows, first, last, loop, law, to, weight); });
}
template <class Law>
void add_tangent(Geometry geometry, const FieldBlock& block, const LoopLevel& level, const Law& law,
                 const MatrixScatter& to, double weight) {
  add_tangent(geometry, block, level, law, to, weight, 0, block.elements);
}

}  // namespace mudline
