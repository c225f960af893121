#pragma once

#include <memory>

#include "framework/term.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// R_u = int N^T rho a dv at the alpha level; the bulk density rho = n rho_f + (1-n) rho_s follows the deformation.
std::unique_ptr<Term> inertia(std::shared_ptr<const Soil> soil);

}  // namespace mudline
