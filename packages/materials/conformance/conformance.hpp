#pragma once

#include <string>
#include <vector>

#include "core/registry.hpp"
#include "materials/skeleton.hpp"

namespace mudline {

/// Limits of the checks. The defaults are those for mudline's own laws.
struct ConformanceLimits {
  // Errors of the tangent relative to its largest entry. Occasionally the two sides of a difference have different
  // numbers of substeps, or straddle first yield; hence quantiles.
  double tangent_median = 1e-8, tangent_99 = 1e-7, tangent_worst = 1e-3;
  double rotation = 1e-8, idle = 1e-8;
  int tangent_points = 2000, rotation_points = 1000, random_points = 10000;
  bool may_fail = false;  // points may report failure at strain increments up to 5 %
};

struct ConformanceCheck {
  std::string name;
  bool passed;
  std::string figures;  // measured values, one line
};

/// Checks the requirements on every skeleton law: purity, tangent, isotropy, finite numbers, documentation.
/// `documentation` is that of its registered type. Every call uses the same points.
std::vector<ConformanceCheck> check_conformance(const Skeleton& law, const EntryDoc& documentation,
                                                const ConformanceLimits& limits = {});

}  // namespace mudline
