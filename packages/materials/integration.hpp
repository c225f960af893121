#pragma once

#include "core/parameters.hpp"

namespace mudline {

/// Options for the stress integration of plastic laws over one increment; all of them use the same parameters.
struct IntegrationOptions {
  enum class Method { modified_euler, dormand_prince, implicit };

  double stress_tolerance = 1e-4;  // largest relative local error of an explicit substep
  double yield_tolerance = 1e-9;   // for the model's dimensionless yield function
  int maximum_substeps = 1000;     // attempts per increment
  Method method = Method::dormand_prince;

  /// Defaults for laws with constant elasticity, where one backward Euler step is cheap and seldom fails.
  static IntegrationOptions implicit() {
    IntegrationOptions r;
    r.method = Method::implicit;
    return r;
  }

  /// `yield_scale` completes "Distance from the yield surface, relative to ..., that counts as on it".
  void parameters(Parameters& p, const std::string& yield_scale);
  /// InputError for options that the chosen method would ignore.
  void check(const Section& section) const;
};

}  // namespace mudline
