#pragma once

namespace mudline {

/// Share of the force that a point which touches or leaves within a step exerts over that step, as if the gap changed
/// linearly: with it the force does the work that its penalty spring stores or gives back (the discrete gradient at
/// alpha_f = 1/2, less given back than stored below), so that an impact adds no energy, however long the step.
struct ImpactShare {
  double value = 1, slope = 0;  // slope: by the gap at the end [1/m]
};

/// gap_old > 0, gap < 0: share of the force at the end.
inline ImpactShare closing_share(double gap_old, double gap) {
  const double way = gap_old - gap;
  return {-gap / way, -gap_old / (way * way)};
}

/// gap_old < 0, gap >= 0: share of the force at the start.
inline ImpactShare leaving_share(double gap_old, double gap) {
  const double way = gap - gap_old;
  return {-gap_old / way, gap_old / (way * way)};
}

}  // namespace mudline
