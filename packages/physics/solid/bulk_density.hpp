#pragma once

#include "physics/mixture.hpp"

namespace mudline {

/// Density of the soil at the points of `at`, which has the elements of the soil's block b.
struct BulkDensity {
  ByMaterial<Mixture> mixtures;
  PointView void_ratio;
  int points, soil_points;  // number of points per element: in `at`, and of those with a void ratio
  bool submerged;           // less the uplift of the water, alpha rho_f

  BulkDensity(const Soil& soil, const SoilBlock& b, const FieldBlock& at, const State& state, bool submerged_)
      : mixtures(mixtures_of(soil, b, state)),
        void_ratio(state.arrays[b.void_ratio]),
        points(at.points),
        soil_points(b.points),
        submerged(submerged_) {}

  /// Density of the point. Where the points are not those of the soil, it is the density of the element: by its mean
  /// void ratio or, with several materials, the mean over its points.
  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION T operator()(int row, const PointFields<C, S, T>& at) const {
    if (points == soil_points) return density(mixtures(row), void_ratio(row, 0), at);
    const int first = row / points * soil_points;
    double ratio = 0;
    bool one = true;
    for (int q = 0; q < soil_points; ++q) {
      ratio += void_ratio(first + q, 0);
      one = one && mixtures.which(first + q, 0) == mixtures.which(first, 0);
    }
    if (one) return density(mixtures(first), ratio / soil_points, at);
    T sum = 0.0;
    for (int q = 0; q < soil_points; ++q) sum += density(mixtures(first + q), void_ratio(first + q, 0), at);
    return sum * (1.0 / soil_points);
  }

 private:
  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION T density(const Mixture& mixture, double ratio, const PointFields<C, S, T>& at) const {
    return mixture.density(mixture.porosity(ratio, at), at) - (submerged ? mixture.alpha * mixture.fluid_density : 0.0);
  }
};

}  // namespace mudline
