#pragma once

#include "tensor/dual.hpp"

namespace mudline {

/// Share of the penalty force at the end of a dynamic step, where there is one (gap < 0), in the mean force over the
/// step, as if the gap changed linearly. Without damping share * force * change of gap is the energy that the spring
/// stores or releases (a discrete gradient), however long the step is. With damping the spring takes more and releases
/// less. Gaps are those of the conjugate positions [m], see ImpactView; 0 <= damping <= 1/2.
template <class T>
T end_share(const T& gap_old, const T& gap, double damping) {
  const double whole = 0.5 + damping;
  if (value(gap_old) <= 0) return T(whole);
  if (value(gap) >= 0) return T(0.0);
  return -whole * gap / (gap_old - gap);
}

/// Share of the force at the start of the step: end_share() backwards in time.
template <class T>
T start_share(const T& gap_old, const T& gap, double damping) {
  return value(gap_old) >= 0 ? T(0.0) : end_share(gap, gap_old, -damping);
}

}  // namespace mudline
