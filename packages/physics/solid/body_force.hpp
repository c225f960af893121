#pragma once

#include <memory>

#include "framework/term.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// Gravity as a vector times a function of time (a factor to switch it on).
struct Gravity {
  Point vector{};        // [m/s2]
  Function factor{1.0};  // function of time
  /// Unit vector against gravity; for zero gravity the last direction of the mesh.
  Point up(int dimension) const;
  Point at(double time) const {
    const double f = factor(time, {0, 0, 0});
    return {f * vector[0], f * vector[1], f * vector[2]};
  }
};

/// R_u = int N^T rho a dv at the alpha level; the bulk density rho = n rho_f + (1-n) rho_s follows the deformation.
std::unique_ptr<Term> inertia(std::shared_ptr<const Soil> soil);

/// R_u = -int N^T rho g dv at the alpha level, with the density of inertia(). With pore pressures in excess of water at
/// rest, gravity acts on rho - alpha rho_f.
std::unique_ptr<Term> weight(std::shared_ptr<const Soil> soil, const Gravity& gravity);

}  // namespace mudline
