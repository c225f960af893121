#pragma once

#include <Kokkos_Core.hpp>

#include "tensor/mat.hpp"

namespace mudline {

// What a law of balance sees and says at one quadrature point. T is double, or a dual number whose derivatives are with
// respect to the unknowns' values and gradients there. C: the coordinate system, S: number of scalar fields beside
// displacement.

/// All fields at a point, at the level at which the balance is taken.
template <class C, int S, class T>
struct PointFields {
  static constexpr int D = C::dim;
  Mat<double, D> moved;          // gradient of the displacement since the step's start
  double hoop_moved;             // its u_r / r in axial symmetry
  T volume_ratio;                // dv over that of the step's start [-]
  T velocity[D];                 // [m/s]
  Mat<T, D> velocity_gradient;   // dv_i / dx_j [1/s]
  T hoop_rate;                   // v_r / r in axial symmetry, else 0 [1/s]
  T acceleration[D];             // [m/s2]
  T value[S > 0 ? S : 1];        // of the scalar fields
  T change[S > 0 ? S : 1];       // since the start of the step
  T rate[S > 0 ? S : 1];         // [1/s]
  T gradient[S > 0 ? S : 1][D];  // [1/m]

  /// Rate of volume strain [1/s].
  KOKKOS_INLINE_FUNCTION T divergence() const {
    T sum = hoop_rate;
    for (int i = 0; i < D; ++i) sum += velocity_gradient[i][i];
    return sum;
  }
};

/// What a balance puts in per volume: int [force . w + stress : grad w] dv for the displacement's test functions w,
/// int [storage q + flux . grad q] dv for those of each scalar field.
template <class C, int S, class T>
struct PointBalance {
  static constexpr int D = C::dim;
  T force[D];                // [N/m3]
  Mat<T, D> stress;          // [Pa]
  T hoop_stress;             // [Pa] of axial symmetry
  T storage[S > 0 ? S : 1];  // of the scalar's conjugate per volume and second
  T flux[S > 0 ? S : 1][D];  // minus the flow per area, where the flow follows its own gradient downhill
  // What of this acts in the step, where not all of it does:
  double standing_force[D] = {};  // part of the force that stood before the step [N/m3]
  Mat<double, D> stress_change;   // change of the skeleton's stress [Pa]
  double hoop_change;             // its hoop component [Pa]
  double pressure_change;         // of the isotropic stress of the pore fluid [Pa]
  // Size of the numbers of which a storage is the difference: their rounding is in the residual.
  double cancelled[S > 0 ? S : 1] = {};
};

}  // namespace mudline
