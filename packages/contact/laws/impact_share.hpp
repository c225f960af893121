#pragma once

#include "tensor/dual.hpp"

namespace mudline {

/// Share of its penalty force that a contact point exerts on the mean over a dynamic step, as if the gap changed
/// linearly. Without damping share * force * change of gap is the energy that the spring stores or gives back (a
/// discrete gradient), however long the step; with it more is taken and less given back. Gaps are those of the
/// conjugate positions [m], see ImpactView; 0 <= damping <= 1/2.
/// Of the force at the end of the step, where there is one (gap < 0).
template <class T>
T end_share(const T& gap_old, const T& gap, double damping) {
  const double whole = 0.5 + damping;
  if (value(gap_old) <= 0) return T(whole);
  if (value(gap) >= 0) return T(0.0);
  return -whole * gap / (gap_old - gap);
}

/// Of the force at the start: the same backwards in time.
template <class T>
T start_share(const T& gap_old, const T& gap, double damping) {
  return value(gap_old) >= 0 ? T(0.0) : end_share(gap, gap_old, -damping);
}

}  // namespace mudline
