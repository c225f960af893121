#pragma once

#include <string>

#include "contact/laws/friction.hpp"
#include "contact/laws/normal_law.hpp"

namespace mudline {

/// Checks the slopes of a contact law against differences of its values at some hundred points. Returns a message such
/// as "d strength / d normal is 0, differences give 0.43 (...)"; "" where they agree. Newton's method does not converge
/// with wrong slopes. At a kink the slope of either side is right. The message also tells that a law throws.
std::string slope_problem(const Friction& law);
/// `stiffness`: a penalty [Pa/m] of the usual size.
std::string slope_problem(const NormalLaw& law, double stiffness = 1e9);

}  // namespace mudline
