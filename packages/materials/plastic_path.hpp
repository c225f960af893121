#pragma once

#include "materials/integration.hpp"
#include "materials/stress_space.hpp"

namespace mudline {

/// Data of a model at one state for the plastic rate equations. Gradients with respect to stress are strains of N
/// numbers (stress_space.hpp), H is the number of hardening variables.
template <class T, int H, int N = 6>
struct PlasticFlow {
  T bulk, shear;            // [Pa] tangential elastic moduli
  T coupling;               // [1/Pa] see elastic_rate(); unused by models that are not `coupled`
  T yield_gradient[N];      // a = df/dsigma
  T flow_direction[N];      // b = dg/dsigma; unused by associated models
  T hardening_gradient[H];  // df/dh
  T hardening_rate[H];      // B in dh = dlambda B
};

/// D strain: isotropic elasticity, and with a positive `coupling` c [1/Pa] besides c sigma (sigma : strain). The latter
/// couples volume and shear where the stiffness follows the mean stress and the stress has a potential.
template <class Space, class T>
KOKKOS_INLINE_FUNCTION void elastic_rate(const Space& space, const T& bulk, const T& shear, const T& coupling,
                                         const T* stress, const T* strain, T* out) {
  space.isotropic(bulk, shear, strain, out);
  if (!(value(coupling) > 0.0)) return;
  const T along = coupling * space.work(stress, strain);
  for (int i = 0; i < Space::size; ++i) out[i] += along * stress[i];
}

/// One increment of one material point: the common part of explicit and implicit integration. Models have
/// rate-independent plasticity with isotropic tangential elasticity, or that of elastic_rate():
///     dsigma = D (deps - dlambda b),  dh = dlambda B,  f(sigma, h) <= 0
///
/// A Model provides (KOKKOS_INLINE_FUNCTION, tension positive):
///     static constexpr int hardening;                       number of hardening variables, at least 1
///     static constexpr bool associated;                     b = a
///     static constexpr bool coupled;                        flow() sets the coupling of the elasticity too
///     space                                                 representation of stresses (stress_space.hpp)
///     T yield(const T* stress, const T* h) const;           dimensionless, negative inside, of order 1 outside
///     void flow(const T* stress, const T* h, const T& volume_strain, PlasticFlow<T, hardening>&) const;
///     void elastic(const T* stress, const T* strain, T* out) const;    exact, from the start of the increment
///     void elastic_step(const T* stress, const T* strain, const T& volume_strain, T* out) const;
///                                                           the same from any state, with the density that belongs to
///                                                           the volume strain; for implicit integration
///     bool admissible(const double* stress, const double* h) const;    where all of the above are defined
///     bool exhausted(const double* stress) const;           whether to stop: the model handles such states
///     double hardening_scale(int i, double h) const;        reference for the error of variable i
///     static constexpr bool trapezoidal;                    implicit: mean flow of start and end; for smooth surfaces
///     T hardening_measure(int i, const T& h) const;         implicit: h changes by `hardened` of B over this,
///     T hardened(int i, const S& h, const T& x) const;      h + x with a measure of 1, h exp(x) with h
/// T is double or a Dual. volume_strain: trace of the strain since the start of the increment.
template <class T, class Model>
class PlasticPath {
 public:
  static constexpr int H = Model::hardening, N = std::decay_t<decltype(Model::space)>::size;
  template <class X>
  using Flow = PlasticFlow<X, H, N>;

  KOKKOS_INLINE_FUNCTION PlasticPath(const Model& model, const IntegrationOptions& options, const T* strain)
      : model_(model), options_(options), volume_(model.space.trace(strain)) {
    copy(strain, strain_, N);
  }

  T stress[N];       // [Pa] before integration: old; after: new
  T h[H];            // hardening variables, likewise
  int substeps = 0;  // attempts, those that were rejected included; 0: elastic

 protected:
  static KOKKOS_INLINE_FUNCTION void copy(const T* from, T* to, int n) {
    for (int i = 0; i < n; ++i) to[i] = from[i];
  }

  KOKKOS_INLINE_FUNCTION bool admissible(const T* sigma, const T* hardening) const {
    double s[N], x[H];
    for (int i = 0; i < N; ++i) s[i] = value(sigma[i]);
    for (int i = 0; i < H; ++i) x[i] = value(hardening[i]);
    return model_.admissible(s, x);
  }

  /// Makes the state at the start of the increment admissible, on or inside the surface. A transferred state, or one
  /// whose strength has just decreased, may lie outside. False where that fails.
  KOKKOS_INLINE_FUNCTION bool prepare() {
    if (!admissible(stress, h)) return false;
    return value(model_.yield(stress, h)) <= options_.yield_tolerance || correct_drift(T(0.0));
  }

  /// D strain at a state with its flow.
  template <class X>
  KOKKOS_INLINE_FUNCTION void elastic(const Flow<X>& flow, const X* sigma, const X* strain, X* out) const {
    if constexpr (Model::coupled)
      elastic_rate(model_.space, flow.bulk, flow.shear, flow.coupling, sigma, strain, out);
    else
      model_.space.isotropic(flow.bulk, flow.shear, strain, out);
  }

  /// Computes D b and a.D b - df/dh.B; false where the latter is not positive (softening faster than elastic
  /// unloading).
  KOKKOS_INLINE_FUNCTION bool plastic_modulus(const Flow<T>& flow, const T* sigma, T* db, T& modulus) const {
    elastic(flow, sigma, Model::associated ? flow.yield_gradient : flow.flow_direction, db);
    modulus = model_.space.work(db, flow.yield_gradient);
    for (int i = 0; i < H; ++i) modulus -= flow.hardening_gradient[i] * flow.hardening_rate[i];
    return value(modulus) > 0.0;
  }

  /// Returns the stress to the surface at fixed strain with dlambda = f/(a.D b - df/dh.B), or along the normal of the
  /// surface where that step is not possible or does not reduce |f|.
  KOKKOS_INLINE_FUNCTION bool correct_drift(const T& time) {
    T f = model_.yield(stress, h);
    for (int iteration = 0; iteration < 30; ++iteration) {
      if (::fabs(value(f)) <= options_.yield_tolerance) return true;
      Flow<T> flow;
      T db[N], modulus, s[N], x[H];
      model_.flow(stress, h, volume_ * time, flow);
      bool consistent = plastic_modulus(flow, stress, db, modulus);
      if (consistent) {
        const T multiplier = f / modulus;
        for (int i = 0; i < N; ++i) s[i] = stress[i] - multiplier * db[i];
        for (int i = 0; i < H; ++i) x[i] = h[i] + multiplier * flow.hardening_rate[i];
        consistent = admissible(s, x) && ::fabs(value(model_.yield(s, x))) < ::fabs(value(f));
      }
      if (!consistent) {
        copy(h, x, H);
        model_.space.as_stress(flow.yield_gradient, db);
        const T step = f / model_.space.work(flow.yield_gradient, db);
        for (int i = 0; i < N; ++i) s[i] = stress[i] - step * db[i];
        if (!admissible(s, x)) return false;
      }
      copy(s, stress, N);
      copy(x, h, H);
      f = model_.yield(stress, h);
    }
    return false;
  }

  const Model& model_;
  const IntegrationOptions& options_;
  T strain_[N], volume_;
};

/// Elasticity with constant moduli: the elastic part of a model.
struct ConstantElasticity {
  double bulk, shear;  // [Pa]

  static constexpr bool trapezoidal = false, coupled = false;
  SixComponents space = {};  // a member, because nvcc knows no static objects on a device
  template <class T>
  KOKKOS_INLINE_FUNCTION double hardening_measure(int, const T&) const {
    return 1.0;
  }
  template <class S, class T>
  KOKKOS_INLINE_FUNCTION T hardened(int, const S& h, const T& x) const {
    return h + x;
  }

  template <class S, class T>
  KOKKOS_INLINE_FUNCTION void elastic(const S* stress, const T* strain, T* out) const {
    sym6::isotropic(bulk, shear, strain, out);
    for (int i = 0; i < 6; ++i) out[i] += stress[i];
  }
  template <class S, class T>
  KOKKOS_INLINE_FUNCTION void elastic_step(const S* stress, const T* strain, const T&, T* out) const {
    elastic(stress, strain, out);
  }
  KOKKOS_INLINE_FUNCTION bool admissible(const double*, const double*) const { return true; }
  KOKKOS_INLINE_FUNCTION bool exhausted(const double*) const { return false; }
  KOKKOS_INLINE_FUNCTION double hardening_scale(int, double) const { return 1.0; }  // h is a plastic strain
};

/// Strain component of derivative index k of N: all six, or the four of a plane problem (no yz and xz).
template <int N>
KOKKOS_INLINE_FUNCTION constexpr int strain_component(int k) {
  static_assert(N == 4 || N == 6, "the directions of a plane problem or all");
  return N == 4 && k == 3 ? 5 : k;
}
/// Makes a dual strain increment with those components as independent variables.
template <int N>
KOKKOS_INLINE_FUNCTION void make_variable(const double* strain, Dual<N>* variable) {
  for (int i = 0; i < 6; ++i) variable[i] = Dual<N>(strain[i]);
  for (int k = 0; k < N; ++k) variable[strain_component<N>(k)].d[k] = 1.0;
}
/// Writes d stress_i / d strain_j, row-major, from a stress computed with such a strain; zero for the other components.
template <int N>
KOKKOS_INLINE_FUNCTION void write_tangent(const Dual<N>* stress, double* tangent) {
  for (int i = 0; i < 36; ++i) tangent[i] = 0.0;
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < N; ++k) tangent[6 * i + strain_component<N>(k)] = stress[i].d[k];
}
KOKKOS_INLINE_FUNCTION void write_tangent(const double*, double*) {}

}  // namespace mudline
