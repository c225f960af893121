#pragma once

namespace mudline {

/// Share of its penalty force that a contact point exerts on the mean over a dynamic step, as if the gap changed
/// linearly. Without damping share * force * change of gap is the energy that the spring stores or gives back (a
/// discrete gradient), however long the step; with it more is taken and less given back. Gaps are those of the
/// conjugate positions, see StepView::ahead_end.
struct ImpactShare {
  double value, slope;  // slope: by the gap at the end [1/m]
};

/// Of the force at the end of the step, where there is one (gap < 0); 0 <= damping <= 1/2.
inline ImpactShare end_share(double gap_old, double gap, double damping) {
  const double whole = 0.5 + damping;
  if (gap_old <= 0) return {whole, 0};
  if (gap >= 0) return {0, 0};
  const double way = gap_old - gap;
  return {-whole * gap / way, -whole * gap_old / (way * way)};
}

/// Of the force at the start.
inline ImpactShare start_share(double gap_old, double gap, double damping) {
  const double whole = 0.5 - damping;
  if (gap_old >= 0) return {0, 0};
  if (gap <= 0) return {whole, 0};
  const double way = gap - gap_old;
  return {-whole * gap_old / way, whole * gap_old / (way * way)};
}

/// Of the forces at both ends in the mean over the step.
struct StepShares {
  ImpactShare start, end;
};

inline StepShares conserving_shares(double gap_old, double gap, double damping) {
  return {start_share(gap_old, gap, damping), end_share(gap_old, gap, damping)};
}

/// Those of the integrator, which weighs the start by `start_weight`.
inline StepShares interpolated_shares(double start_weight) { return {{start_weight, 0}, {1 - start_weight, 0}}; }

}  // namespace mudline
