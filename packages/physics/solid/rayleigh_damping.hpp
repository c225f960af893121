#pragma once

#include <memory>

#include "framework/term.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// R_u = (a M + b K_el) v: mass and elastic stiffness of the committed configuration and state (frozen during the step,
/// so the term is linear in v). Damping ratio of a mode: a/(2 w) + b w/2.
std::unique_ptr<Term> rayleigh_damping(std::shared_ptr<const Soil> soil, double mass_factor, double stiffness_factor);

}  // namespace mudline
