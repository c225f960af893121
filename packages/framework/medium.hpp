#pragma once

#include <utility>

#include "framework/loop_term.hpp"

namespace mudline {

/// The balances of the scalar fields of a medium, written at one point. A medium inherits this struct, names its fields
/// at compile time, and has one or both of the functions below. Both start from zero storages and fluxes.
///     struct Heat : Medium {
///       enum { temperature, scalars };  // indices of the scalar fields, and their number
///       template <class C, class T>  // what is stored over the step, over its length
///       KOKKOS_INLINE_FUNCTION void stored(int row, const PointFields<C, scalars, T>& at,
///                                          PointBalance<C, scalars, T>& out) const;
///       template <class C, class T>  // what flows
///       KOKKOS_INLINE_FUNCTION void flows(int row, const PointFields<C, scalars, T>& at,
///                                         PointBalance<C, scalars, T>& out) const;
///     };
/// stored_law() belongs to the end of the step (end_level), flow_law() to the level of balances.
struct Medium {
  static constexpr bool rates = false;    // flows() depends on velocities and rates
  static constexpr bool inertia = false;  // flows() depends on accelerations
  static constexpr bool cancels = false;  // a storage of stored() is the difference of large numbers, see PointLaw
};

template <class M>
struct StoredLaw : PointLaw {
  static constexpr int fields = M::scalars;
  static constexpr bool storages = true, rates = false, shape = false, cancels = M::cancels;
  M medium;

  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    for (int k = 0; k < S; ++k) out.storage[k] = 0.0;
    medium.stored(row, at, out);
  }
};

template <class M>
struct FlowLaw : PointLaw {
  static constexpr int fields = M::scalars;
  static constexpr bool storages = true, fluxes = true, gradients = true, rates = M::rates, inertia = M::inertia;
  M medium;

  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    for (int k = 0; k < S; ++k) {
      out.storage[k] = 0.0;
      for (int i = 0; i < C::dim; ++i) out.flux[k][i] = 0.0;
    }
    medium.flows(row, at, out);
  }
};

/// The laws of a medium, for a loop_term.
template <class M>
StoredLaw<M> stored_law(M medium) {
  return {{}, std::move(medium)};
}
template <class M>
FlowLaw<M> flow_law(M medium) {
  return {{}, std::move(medium)};
}

}  // namespace mudline
