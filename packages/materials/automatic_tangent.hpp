#pragma once

#include "materials/implicit_return.hpp"
#include "materials/pointwise.hpp"
#include "materials/substepping.hpp"

namespace mudline {

/// Gives a law its tangent by differentiation. The law writes its stress once, as a template on the number type:
///     template <class T>
///     KOKKOS_FUNCTION bool update(const SkeletonPoint& in, const T* strain, const double* state_old, T* stress,
///                                 double* state) const;
/// where `strain` is the increment (in.strain as independent variables) and `state` holds a copy of the old state; the
/// rest is that of pointwise.hpp. Register it as PointwiseSkeleton<AutomaticTangent<MyLaw>>. A point that fails shows
/// its old stress.
template <class Law>
struct AutomaticTangent : Law {
  AutomaticTangent() = default;
  AutomaticTangent(const Law& law) : Law(law) {}  // NOLINT: the same law with a tangent

  KOKKOS_INLINE_FUNCTION bool operator()(const SkeletonPoint& in, const double* state_old, double* state,
                                         SkeletonResponse& out) const {
    for (int i = 0; i < Law::state_size; ++i) state[i] = state_old[i];
    const bool ok = !in.want_tangent ? this->update(in, in.strain, state_old, out.stress, state)
                    : in.plane       ? differentiate<4>(in, state_old, state, out)
                                     : differentiate<6>(in, state_old, state, out);
    if (!ok)
      for (int i = 0; i < 6; ++i) out.stress[i] = in.stress[i];
    return ok;
  }

 private:
  template <int N>
  KOKKOS_INLINE_FUNCTION bool differentiate(const SkeletonPoint& in, const double* state_old, double* state,
                                            SkeletonResponse& out) const {
    Dual<N> strain[6], stress[6];
    make_variable(in.strain, strain);
    const bool ok = this->update(in, strain, state_old, stress, state);
    for (int i = 0; i < 6; ++i) out.stress[i] = stress[i].v;
    write_tangent(stress, out.tangent);
    return ok;
  }
};

/// Moves `stress` and the hardening variables `h` over one increment along a path of class Path.
template <class Path, class T, class Model>
KOKKOS_INLINE_FUNCTION bool integrate_plasticity_by(const Model& model, const IntegrationOptions& options,
                                                    const T* strain, T* stress, T* h) {
  Path path(model, options, strain);
  for (int i = 0; i < Path::N; ++i) path.stress[i] = stress[i];
  for (int i = 0; i < Model::hardening; ++i) path.h[i] = h[i];
  if (!path.integrate()) return false;
  for (int i = 0; i < Path::N; ++i) stress[i] = path.stress[i];
  for (int i = 0; i < Model::hardening; ++i) h[i] = path.h[i];
  return true;
}

/// The same by the method of the options.
template <class T, class Model>
KOKKOS_INLINE_FUNCTION bool integrate_plasticity(const Model& model, const IntegrationOptions& options, const T* strain,
                                                 T* stress, T* h) {
  return options.method == IntegrationOptions::Method::implicit
             ? integrate_plasticity_by<ImplicitReturn<T, Model>>(model, options, strain, stress, h)
             : integrate_plasticity_by<Substepping<T, Model>>(model, options, strain, stress, h);
}

/// The update of a law with one hardening variable, from h_old to h_new.
template <class T, class Model>
KOKKOS_INLINE_FUNCTION bool integrate_point(const Model& model, const IntegrationOptions& options,
                                            const SkeletonPoint& in, const T* strain, double h_old, T* stress,
                                            double& h_new) {
  static_assert(Model::hardening == 1, "the caller has one variable");
  for (int i = 0; i < 6; ++i) stress[i] = T(in.stress[i]);
  T h[1] = {T(h_old)};
  if (!integrate_plasticity(model, options, strain, stress, h)) return false;
  h_new = value(h[0]);
  return true;
}

}  // namespace mudline
