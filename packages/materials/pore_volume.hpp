#pragma once

#include <Kokkos_Core.hpp>

#include <cmath>

namespace mudline {

/// Porosity after a volume change: n = alpha - (alpha - n_old) exp(-(ln J + dp/K_s)); solid mass is conserved exactly
/// for alpha = 1. grain_strain: dp/K_s [-], the compression of the grains by the pore pressure.
KOKKOS_INLINE_FUNCTION double porosity_after(double alpha, double old, double log_volume, double grain_strain) {
  return alpha - (alpha - old) * ::exp(-(log_volume + grain_strain));
}

}  // namespace mudline
