#pragma once

#include "materials/automatic_tangent.hpp"

namespace mudline {

/// Compressible neo-Hookean elasticity (Bonet & Wood 1997, Nonlinear Continuum Mechanics, ch. 5), for skeletons and
/// solids that stretch far without yielding:
///     sigma = (G/J)(b - 1) + (Lambda ln J/J) 1,  J = sqrt(det b),  Lambda = K - 2G/3
/// b is the left Cauchy-Green tensor; b - 1 is a state variable, free of cancellation at small strain, that rotates
/// with the material. One increment takes b to
///     b_new = exp(deps) R b R^T exp(deps)
/// with the objective strain increment deps and rotation R of the step, so the law needs no deformation gradient. This
/// is exact where a step does not both stretch and rotate (J is always exact); otherwise the error of a step is of
/// second order in its size, so that the accumulated error of many steps is of first order. The initial b is the one
/// that gives the initial stress. The tangent comes by automatic differentiation. Code: tension positive, [Pa].
struct NeoHookean {
  static constexpr bool volume_apart = true, no_strength = true;
  enum { left_cauchy_green_strain, state_size = 6 };

  double young = 1e7;    // [Pa] at small strain
  double poisson = 0.3;  // [-] at small strain

  void parameters(Parameters& p) {
    p.required("Young's modulus", young, "Pa", positive(), "Stiffness at small strain");
    p.required("Poisson's ratio", poisson, "-", half_open(0.0, 0.5),
               "Ratio of lateral contraction to extension at small strain");
  }
  static std::vector<StateVariable> state() { return {{"left cauchy-green strain", 6, "-"}}; }
  std::string initialise(const InitialPoint& point, double* state) const;

  KOKKOS_INLINE_FUNCTION ElasticModuli moduli(const double*, double, const double*) const {
    return {young / (3.0 * (1.0 - 2.0 * poisson)), 0.5 * young / (1.0 + poisson)};
  }
  template <class T>
  KOKKOS_INLINE_FUNCTION bool update(const SkeletonPoint& in, const T* strain, const double* state_old, T* stress,
                                     double* state) const;
};

namespace sym6 {

/// Product a b of two symmetric tensors that commute, so that it is symmetric; `out` may be a or b.
template <class T>
KOKKOS_INLINE_FUNCTION void commuting_product(const T* a, const T* b, T* out) {
  const T r[6] = {a[0] * b[0] + a[5] * b[5] + a[4] * b[4], a[5] * b[5] + a[1] * b[1] + a[3] * b[3],
                  a[4] * b[4] + a[3] * b[3] + a[2] * b[2], a[5] * b[4] + a[1] * b[3] + a[3] * b[2],
                  a[0] * b[4] + a[5] * b[3] + a[4] * b[2], a[0] * b[5] + a[5] * b[1] + a[4] * b[3]};
  for (int i = 0; i < 6; ++i) out[i] = r[i];
}

/// a b a
template <class T, class S>
KOKKOS_INLINE_FUNCTION void sandwich(const T* a, const S* b, T* out) {
  constexpr int at[9] = {0, 5, 4, 5, 1, 3, 4, 3, 2};
  constexpr int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  T half[9];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      half[3 * i + j] = a[at[3 * i]] * b[at[j]] + a[at[3 * i + 1]] * b[at[3 + j]] + a[at[3 * i + 2]] * b[at[6 + j]];
  for (int c = 0; c < 6; ++c) {
    const T* h = half + 3 * row[c];
    out[c] = h[0] * a[at[column[c]]] + h[1] * a[at[3 + column[c]]] + h[2] * a[at[6 + column[c]]];
  }
}

/// exp(a) - 1 of a tensor with stress-like components: Taylor series of a fraction that is small enough, followed by
/// repeated squaring with (1 + g)^2 - 1 = 2 g + g g.
template <class T>
KOKKOS_INLINE_FUNCTION void exponential_minus_one(const T* a, T* out) {
  double size = 0.0;
  for (int i = 0; i < 6; ++i) size = ::fmax(size, ::fabs(value(a[i])));
  int squarings = 0;
  double scale = 1.0;
  while (size * scale > 0.05 && squarings < 40) {
    scale *= 0.5;
    ++squarings;
  }
  T part[6], term[6];
  for (int i = 0; i < 6; ++i) out[i] = term[i] = part[i] = scale * a[i];
  for (int n = 2; n <= 8; ++n) {
    commuting_product(term, part, term);
    for (int i = 0; i < 6; ++i) {
      term[i] *= 1.0 / n;
      out[i] += term[i];
    }
  }
  for (int n = 0; n < squarings; ++n) {
    commuting_product(out, out, term);
    for (int i = 0; i < 6; ++i) out[i] = 2.0 * out[i] + term[i];
  }
}

/// det(1 + a) - 1
template <class T>
KOKKOS_INLINE_FUNCTION T determinant_excess(const T* a) {
  const T minors = a[0] * a[1] - a[5] * a[5] + a[1] * a[2] - a[3] * a[3] + a[2] * a[0] - a[4] * a[4];
  return trace(a) + minors + determinant(a);
}

}  // namespace sym6

template <class T>
KOKKOS_INLINE_FUNCTION bool NeoHookean::update(const SkeletonPoint&, const T* strain, const double* state_old,
                                               T* stress, double* state) const {
  const ElasticModuli m = moduli(nullptr, 0.0, nullptr);
  T half[6], strain_of_two[6], stretch[6], b[6];  // exp(deps) - 1, exp(2 deps) - 1, exp(deps), b - 1
  for (int i = 0; i < 6; ++i) b[i] = (i < 3 ? 1.0 : 0.5) * strain[i];
  sym6::exponential_minus_one(b, half);
  sym6::commuting_product(half, half, strain_of_two);
  for (int i = 0; i < 6; ++i) {
    strain_of_two[i] += 2.0 * half[i];
    stretch[i] = half[i] + (i < 3 ? 1.0 : 0.0);
  }
  sym6::sandwich(stretch, state_old, b);
  for (int i = 0; i < 6; ++i) b[i] += strain_of_two[i];
  const T excess = sym6::determinant_excess(b);  // J^2 - 1
  if (!(value(excess) > 1e-30 - 1.0 && value(excess) < 1e30)) return false;
  const T j = square_root(1.0 + excess),
          log_j = chain(excess, 0.5 * ::log1p(value(excess)), 0.5 / (1.0 + value(excess)));
  const T volume = (m.bulk - m.shear * (2.0 / 3.0)) * log_j / j, shear = m.shear / j;
  for (int i = 0; i < 6; ++i) {
    stress[i] = shear * b[i] + (i < 3 ? volume : T(0.0));
    state[i] = value(b[i]);
    if (!(::fabs(state[i]) < 1e30)) return false;
  }
  return true;
}

// Compiled once, in the source of the law.
extern template class PointwiseSkeleton<AutomaticTangent<NeoHookean>>;

}  // namespace mudline
