#pragma once

#include <string>

#include "materials/skeleton.hpp"

namespace mudline {

// Skeleton laws as the rest of the program calls them: a law may be a plugin's or a UMAT, which throw, return numbers
// that are not finite, or describe themselves wrongly.

/// "" or what is wrong with the law's description of its state: names, components.
std::string state_problem(const Skeleton& law);

/// Skeleton::k0, and "" or the problem: it throws or is not finite.
std::string guarded_k0(const Skeleton& law, double overconsolidation_ratio, double& k0);

/// Skeleton::initialise. Returns "" or why the law cannot start: its own reason, what it throws, a state that is not
/// finite, moduli that are not positive.
std::string start_guarded(const Skeleton& law, const InitialPoint& point, double* state);

/// The first point of a batch at which a law gave no answer.
struct LawFailure {
  int point = -1;       // none
  std::string reason;   // "it refuses the increment", "it returns a stress that is not finite", "it throws: ..."
  bool refused = true;  // the law said so itself, which is its right
};

/// Skeleton::evaluate. Points with a stress, state or wanted tangent that is not finite count as failed, and all do
/// when the law throws; they show their old state and no stiffness. Returns the number of failed points. `first`: set
/// where there are any.
int evaluate_guarded(const Skeleton& law, const SkeletonWorkset& workset, LawFailure& first);

/// "effective stress xx yy zz yz xz xy = ... Pa, strain increment ..." of one increment, tension positive.
std::string increment_text(const double* stress, const double* strain);

}  // namespace mudline
