#pragma once

#include <Kokkos_Core.hpp>

#include "tensor/mat.hpp"

namespace mudline {

// Input and output of a balance law at one quadrature point. T is double, or a dual number whose derivatives are with
// respect to the unknowns' values and gradients there. C: the coordinate system, S: number of scalar fields beside
// displacement.

/// All fields at a point, at the time level of the balance.
template <class C, int S, class T>
struct PointFields {
  static constexpr int D = C::dim;
  Mat<double, D> moved;          // gradient of the displacement since the step's start
  double hoop_moved;             // hoop component u_r / r of that in axial symmetry, else 0
  T volume_ratio;                // dv over dv at the start of the step [-]
  T velocity[D];                 // [m/s]
  Mat<T, D> velocity_gradient;   // dv_i / dx_j [1/s]
  T hoop_rate;                   // v_r / r in axial symmetry, else 0 [1/s]
  T acceleration[D];             // [m/s2]
  T value[S > 0 ? S : 1];        // values of the scalar fields
  T change[S > 0 ? S : 1];       // their changes since the start of the step
  T rate[S > 0 ? S : 1];         // [1/s]
  T gradient[S > 0 ? S : 1][D];  // [1/m]

  /// Rate of volume strain [1/s].
  KOKKOS_INLINE_FUNCTION T divergence() const {
    T sum = hoop_rate;
    for (int i = 0; i < D; ++i) sum += velocity_gradient[i][i];
    return sum;
  }
};

/// Contributions of a balance law per volume: int [force . w + stress : grad w] dv for the displacement's test
/// functions w, and int [storage q + flux . grad q] dv for the test functions q of each scalar field.
template <class C, int S, class T>
struct PointBalance {
  static constexpr int D = C::dim;
  T force[D];                // [N/m3]
  Mat<T, D> stress;          // [Pa]
  T hoop_stress;             // [Pa] in axial symmetry
  T storage[S > 0 ? S : 1];  // rate of the scalar's conjugate per volume and second
  T flux[S > 0 ? S : 1][D];  // minus the flow per area (positive up the gradient)
  // The parts that act in the step, where not all of the above does:
  double standing_force[D] = {};  // part of the force that stood before the step [N/m3]
  Mat<double, D> stress_change;   // change of the skeleton's stress [Pa]
  double hoop_change;             // its hoop component [Pa]
  double pressure_change;         // change of the isotropic stress of the pore fluid [Pa]
  // Size of the two numbers whose difference a storage is: their rounding errors enter the residual.
  double cancelled[S > 0 ? S : 1] = {};
};

}  // namespace mudline
