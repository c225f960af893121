#pragma once

#include <string>

#include "materials/skeleton.hpp"

namespace mudline {

// Guarded calls of skeleton laws. A law may be a plugin or a UMAT that throws, returns non-finite numbers or describes
// itself wrongly.

/// "" or the error in the law's description of its state: names, components.
std::string state_problem(const Skeleton& law);

/// Calls Skeleton::k0. Returns "" or the problem: it throws or is not finite.
std::string guarded_k0(const Skeleton& law, const InitialPoint& point, double& k0);

/// Calls Skeleton::find_stress. Returns "" or the problem: its own, it throws, or the stress is not finite.
std::string guarded_stress(const Skeleton& law, InitialPoint& point);

/// Calls Skeleton::initialise. Returns "" or why the law cannot start: its own reason, an exception, a state that is
/// not finite, or moduli that are not positive.
std::string start_guarded(const Skeleton& law, const InitialPoint& point, double* state);

/// The first point of a batch at which a law failed.
struct LawFailure {
  int point = -1;       // none
  std::string reason;   // "it refuses the increment", "it returns a stress that is not finite", "it throws: ..."
  bool refused = true;  // the law itself refused the increment, which is allowed
};

/// Calls Skeleton::evaluate. Points with a non-finite stress, state or wanted tangent count as failed; if the law
/// throws, all points do. Failed points get their old state and zero stiffness. Returns the number of failed points and
/// sets `first` if there are any.
int evaluate_guarded(const Skeleton& law, const SkeletonWorkset& workset, LawFailure& first);

/// Text "effective stress xx yy zz yz xz xy = ... Pa, strain increment ..." for one increment, tension positive.
std::string increment_text(const double* stress, const double* strain);

}  // namespace mudline
