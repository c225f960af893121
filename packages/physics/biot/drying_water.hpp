#pragma once

#include <memory>

#include "framework/term.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// Mass balance of the water in the blocks that dry, as if it filled the pores:
///   R_p = int Np^T [n (1 + p/K_f) dv at the end, less that at the start of the step] / dt
///         + int grad(Np)^T kappa (grad p - rho_f g) dv,  kappa = k_r k(e)/gamma_w,
/// with the relative permeability k_r and the porosity n. pore_air() takes away what is missing. The signs are those
/// of fluid_mass(), which has the other blocks.
std::unique_ptr<Term> drying_water(std::shared_ptr<const Soil> soil);

}  // namespace mudline
