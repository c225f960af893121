#pragma once

#include "core/parameters.hpp"

namespace mudline {

/// A stage's section "strength reduction": the strengths of the soil are divided by a factor that grows from 1 in
/// proportion to the stage's time, until no equilibrium is found (Matsui & San 1992, Soils and Foundations 32:59;
/// Griffiths & Lane 1999, Geotechnique 49:387). A step finds none where Newton's method does not converge, and where
/// the soil moves by more than a share of its height times the growth of the factor: soil that flows at constant volume
/// may come to rest in another shape, which is no equilibrium of this one.
struct StrengthReduction {
  double largest = 1;                // [-] factor at the end of the duration; 1: strengths are not reduced
  double resolution = 0.005;         // [-] largest difference of the factors with and without equilibrium
  double displacement_limit = 0.05;  // [-] largest displacement over the soil's height, per growth of the factor

  void parameters(Parameters& p);
  bool acts() const { return largest > 1; }
  /// Growth of the factor per time [1/s] in a stage of a duration [s].
  double rate(double duration) const { return acts() ? (largest - 1) / duration : 0.0; }
};

}  // namespace mudline
