#pragma once

#include "tensor/dual.hpp"

namespace mudline {

/// Porosity after a volume change: n = alpha - (alpha - n_old) exp(-(ln J + dp/K_s)); solid mass is conserved exactly
/// for alpha = 1. grain_strain: dp/K_s [-], the compression of the grains by the pore pressure.
template <class T>
KOKKOS_INLINE_FUNCTION T porosity_after(double alpha, double old, const T& log_volume, const T& grain_strain) {
  return alpha - (alpha - old) * exponential(-(log_volume + grain_strain));
}

}  // namespace mudline
