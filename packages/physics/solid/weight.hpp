#pragma once

#include <memory>

#include "framework/term.hpp"
#include "physics/soil.hpp"
#include "physics/solid/gravity.hpp"

namespace mudline {

/// R_u = -int N^T rho g dv at the alpha level, with the density of inertia(). With pore pressures in excess of water at
/// rest, gravity acts on rho - alpha rho_f.
std::unique_ptr<Term> weight(std::shared_ptr<const Soil> soil, const Gravity& gravity);

}  // namespace mudline
