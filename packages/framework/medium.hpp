#pragma once

#include "framework/loop_term.hpp"

namespace mudline {

/// The balances of the scalar fields of a medium, written at one point. A medium inherits this struct, names its fields
/// at compile time, and has one or both of the functions below. Both start from zero storages and fluxes.
///     struct Heat : Medium {
///       enum { temperature, scalars };  // indices of the scalar fields, and their number
///       template <class C, class T>     // what is stored over the step, at its end, over the step's length
///       void stored(int row, const PointFields<C, scalars, T>& at, PointBalance<C, scalars, T>& out) const;
///       template <class C, class T>     // what flows, at the level of balances
///       void flows(int row, const PointFields<C, scalars, T>& at, PointBalance<C, scalars, T>& out) const;
///     };
struct Medium {
  static constexpr bool stores = true;    // it has stored()
  static constexpr bool rates = false;    // flows() depends on velocities and rates
  static constexpr bool inertia = false;  // flows() depends on accelerations
  static constexpr bool cancels = false;  // a storage of stored() is the difference of large numbers, see PointLaw
};

/// The law of stored().
template <class M>
struct StoredLaw : PointLaw {
  static constexpr int fields = M::scalars;
  static constexpr bool storages = true, rates = false, cancels = M::cancels;
  M medium;

  template <class C, int S, class T>
  void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    for (int k = 0; k < S; ++k) out.storage[k] = 0.0;
    medium.stored(row, at, out);
  }
};

/// The law of flows().
template <class M>
struct FlowLaw : PointLaw {
  static constexpr int fields = M::scalars;
  static constexpr bool storages = true, fluxes = true, gradients = true, rates = M::rates, inertia = M::inertia;
  M medium;

  template <class C, int S, class T>
  void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    for (int k = 0; k < S; ++k) {
      out.storage[k] = 0.0;
      for (int i = 0; i < C::dim; ++i) out.flux[k][i] = 0.0;
    }
    medium.flows(row, at, out);
  }
};

/// Passes the laws of a medium on one block to `add` of a loop_term. make(level) gives the medium at a level. A
/// geostatic stage takes no time and has none of these laws.
template <class Add, class Make>
void add_medium(const StepView& view, const FieldBlock& block, Add&& add, const Make& make) {
  if (!view.flow) return;
  const LoopLevel balance = loop_level(view, view.balance, block);
  auto medium = make(balance);
  using M = decltype(medium);
  if constexpr (M::stores) {
    const LoopLevel end = end_level(view, block);
    add(block, end, StoredLaw<M>{{}, make(end)});
  }
  add(block, balance, FlowLaw<M>{{}, std::move(medium)});
}

}  // namespace mudline
