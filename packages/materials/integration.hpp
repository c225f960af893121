#pragma once

#include "core/parameters.hpp"

namespace mudline {

/// How plastic laws integrate their rate equations over one increment; one block of parameters for all of them.
struct IntegrationOptions {
  enum class Method { modified_euler, dormand_prince, implicit };

  double stress_tolerance = 1e-4;  // relative local error that an explicit substep may have
  double yield_tolerance = 1e-9;   // on the model's dimensionless yield function
  int maximum_substeps = 1000;     // attempts per increment
  Method method = Method::dormand_prince;

  /// For laws with constant elasticity, where one backward Euler step is cheap and seldom fails.
  static IntegrationOptions implicit() {
    IntegrationOptions r;
    r.method = Method::implicit;
    return r;
  }

  /// `yield_scale` completes "Distance from the yield surface, relative to ..., that counts as on it".
  void parameters(Parameters& p, const std::string& yield_scale);
  /// Refuses what the chosen method would ignore.
  void check(const Section& section) const;
};

}  // namespace mudline
