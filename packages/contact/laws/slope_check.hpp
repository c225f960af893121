#pragma once

#include <string>

#include "contact/laws/friction.hpp"
#include "contact/laws/normal_law.hpp"

namespace mudline {

/// What is wrong with the slopes that a contact law gives beside its values, against differences of these at some
/// hundred points: "d strength / d normal is 0, differences give 0.43 (...)"; "" where they agree. Newton's method does
/// not converge on wrong slopes. At a kink either side will do. A law that throws is told so.
std::string slope_problem(const Friction& law);
/// `stiffness`: a penalty [Pa/m] of the usual size.
std::string slope_problem(const NormalLaw& law, double stiffness = 1e9);

}  // namespace mudline
