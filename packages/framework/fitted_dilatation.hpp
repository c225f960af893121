#pragma once

#include <cmath>

#include "framework/linear_fit.hpp"
#include "tensor/mat.hpp"

namespace mudline {

/// The volume strain of an element, fitted to that of its points (FieldBlock::dilatation_terms). Stresses see it in
/// place of that of each point, so that the element does not lock where the soil keeps its volume. Loop: an ElementLoop
/// without scalar fields.
template <class Loop>
struct FittedDilatation {
  static constexpr int D = Loop::D, NU = Loop::NU, T = D + 1;
  static constexpr bool hoop = Loop::hoop;
  static constexpr int ways = D + (hoop ? 1 : 0);  // directions that share a change of volume
  using Nodes = typename Loop::Nodes;
  using Shape = typename Loop::Shape;
  using Fields = typename Loop::Fields;

  LinearFit<D> fit;
  double swell[T] = {};        // coefficients: growth of the volume in the step, over the volume at the level [-]
  double rate[T] = {};         // coefficients: rate of volume strain [1/s]
  double unit[NU][D][T] = {};  // coefficients: volume strain of a unit displacement of a node [1/m]

  /// Fits the volume strain of an element; false where it is folded. Rates: whether its rate, too.
  template <bool Rates>
  [[gnu::noinline]] KOKKOS_FUNCTION bool find(const Loop& loop, const Nodes& n) {
    fit.count = loop.b.dilatation_terms;
    for (int i = 0; i < D; ++i)
      for (int a = 0; a < NU; ++a) fit.origin[i] += (n.x[a][i] - n.moved[a][i]) / NU;
    fit.size = std::abs(n.x[0][0] - fit.origin[0]) + std::abs(n.x[0][D - 1] - fit.origin[D - 1]);
    for (int q = 0; q < loop.b.points; ++q) {
      Shape s;
      Fields f;
      if (!loop.template shapes<false>(q, n.x, s) || !loop.template fields<Rates, false>(n, s, f)) return false;
      double t[T];
      terms(n, s, t);
      fit.add(t, s.dv);
      for (int k = 0; k < T; ++k) {
        swell[k] += s.dv * t[k] * swell_of(f);
        if constexpr (Rates) rate[k] += s.dv * t[k] * f.divergence();
      }
    }
    if (!fit.finish()) return false;
    fit.solve(swell);
    fit.solve(rate);
    return true;
  }

  /// Puts the fitted volume strain in the place of that of a point, whose change of shape stays. The volume ratio
  /// stays, too: it belongs to the mass of the point. False where the fit turns the point inside out.
  template <bool Rates>
  KOKKOS_INLINE_FUNCTION bool replace(const Nodes& n, const Shape& s, Fields& f) const {
    double t[T];
    terms(n, s, t);
    const double own = swell_of(f), fitted = fit.value(swell, t);
    if (!(fitted < 1)) return false;
    // lengths at the start over those at the level grow by this share
    const double longer = std::expm1(std::log1p((own - fitted) / (1 - own)) / ways);
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) f.moved[i][j] -= longer * ((i == j ? 1.0 : 0.0) - f.moved[i][j]);
    if constexpr (hoop) f.hoop_moved -= longer * (1 - f.hoop_moved);
    if constexpr (Rates) {
      const double more = (fit.value(rate, t) - f.divergence()) / ways;
      for (int i = 0; i < D; ++i) f.velocity_gradient[i][i] += more;
      if constexpr (hoop) f.hoop_rate += more;
    }
    return true;
  }

  /// Fits the volume strains of unit displacements, after find().
  [[gnu::noinline]] KOKKOS_FUNCTION void find_unit(const Loop& loop, const Nodes& n) {
    for (int q = 0; q < loop.b.points; ++q) {
      Shape s;
      loop.template shapes<false>(q, n.x, s);
      double t[T];
      terms(n, s, t);
      const double weight = s.dv * (1 - fit.value(swell, t));
      for (int a = 0; a < NU; ++a)
        for (int j = 0; j < D; ++j)
          for (int k = 0; k < T; ++k) unit[a][j][k] += weight * t[k] * own_unit(s, a, j);
    }
    for (int a = 0; a < NU; ++a)
      for (int j = 0; j < D; ++j) fit.solve(unit[a][j]);
  }

  /// Changes the derivatives Y of a point by the nodes' unknowns as its law sees the fitted volume strain, while volume
  /// and gradients of the test functions follow the point itself. A: the derivatives by the gradients at the point;
  /// out: the law's stress; weight: of the displacement at the level. Layout: Law's rows (Row) and directions.
  template <class Row, int Rows, int Ways, int Columns, class Balance>
  KOKKOS_INLINE_FUNCTION void follow(const Nodes& n, const Shape& s, const Balance& out, double weight,
                                     const double (&A)[Rows][Ways], double (&Y)[Rows][Columns]) const {
    constexpr int first = Row::stress, last = first + D * D + (hoop ? 1 : 0);  // the stresses and the hoop stress
    double swollen[last];  // their derivatives by a swelling that the law alone sees
    for (int row = first; row < last; ++row) {
      swollen[row] = 0;
      for (int k = 0; k < D; ++k) swollen[row] += A[row][D * k + k];
      if constexpr (hoop) swollen[row] += A[row][D * D];
    }
    const double geometry = weight * (ways - 1) * s.dv;
    for (int i = 0; i < D; ++i)
      for (int l = 0; l < D; ++l) swollen[first + D * i + l] -= geometry * out.stress[i][l];
    if constexpr (hoop) swollen[Row::hoop] -= geometry * out.hoop_stress;
    double t[T];
    terms(n, s, t);
    const double start = 1 - fit.value(swell, t);
    for (int a = 0; a < NU; ++a)
      for (int j = 0; j < D; ++j) {
        const double more = (fit.value(unit[a][j], t) / start - own_unit(s, a, j)) / ways;
        for (int row = first; row < last; ++row) Y[row][D * a + j] += swollen[row] * more;
      }
  }

 private:
  /// Terms of the fit at a point, by its place at the start of the step.
  KOKKOS_INLINE_FUNCTION void terms(const Nodes& n, const Shape& s, double (&t)[T]) const {
    double x[D] = {};
    for (int a = 0; a < NU; ++a)
      for (int i = 0; i < D; ++i) x[i] += s.N[a] * (n.x[a][i] - n.moved[a][i]);
    fit.terms(x, t);
  }
  /// Growth of the volume of a point in the step over its volume at the level, without rounding of 1.
  KOKKOS_INLINE_FUNCTION static double swell_of(const Fields& f) {
    const Mat<double, D>& H = f.moved;
    double sum = 0, minors = 0;
    for (int i = 0; i < D; ++i) {
      sum += H[i][i];
      for (int j = 0; j < i; ++j) minors += H[i][i] * H[j][j] - H[i][j] * H[j][i];
    }
    sum -= minors;
    if constexpr (D == 3) sum += determinant(H);
    return sum + f.hoop_moved * (1 - sum);
  }
  /// Volume strain at a point of a unit displacement of node a in direction j [1/m].
  KOKKOS_INLINE_FUNCTION static double own_unit(const Shape& s, int a, int j) {
    return s.g[a][j] + (hoop && j == 0 ? s.h[a] : 0.0);
  }
};

}  // namespace mudline
