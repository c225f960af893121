#pragma once

#include <memory>

#include "framework/term.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// Mass balance of the pore fluid on the configuration of the alpha level:
///   R_p = int Np^T [alpha div v + pdot/Q] dv + int grad(Np)^T kappa (grad p - rho_f g [+ rho_f a]) dv,
///   kappa = k(e)/gamma_w.
/// Blocks that dry are left to drying_water() and pore_air().
/// p: compression positive, outflow positive. In a geostatic stage the pore pressures are prescribed and the term is
/// zero.
std::unique_ptr<Term> fluid_mass(std::shared_ptr<const Soil> soil, bool fluid_acceleration);

}  // namespace mudline
