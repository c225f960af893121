#pragma once

#include <Kokkos_Core.hpp>

#include <stdexcept>

#include "core/pi.hpp"
#include "discretisation/mesh.hpp"

namespace mudline {

// Coordinate systems. Kernels are templates on one of them. `dim`: number of directions. `hoop`: whether there is the
// hoop strain u_r / r out of the plane (axial symmetry). measure(x): length [m] out of the plane that a point stands
// for; 1 in space. T: double or a dual number.

struct PlaneStrain {
  static constexpr int dim = 2;
  static constexpr bool hoop = false;
  template <class T>
  KOKKOS_INLINE_FUNCTION static T measure(const T*) {
    return T(1.0);
  }
};

struct Axisymmetric {
  static constexpr int dim = 2;
  static constexpr bool hoop = true;
  template <class T>
  KOKKOS_INLINE_FUNCTION static T measure(const T* x) {
    return 2 * pi * x[0];
  }
};

struct Space3 {
  static constexpr int dim = 3;
  static constexpr bool hoop = false;
  template <class T>
  KOKKOS_INLINE_FUNCTION static T measure(const T*) {
    return T(1.0);
  }
};

/// Calls f(coordinate system) of a mesh.
template <class F>
auto with_coordinates(Geometry geometry, F&& f) {
  switch (geometry) {
    case Geometry::plane_strain:
      return f(PlaneStrain{});
    case Geometry::axisymmetric:
      return f(Axisymmetric{});
    case Geometry::space:
      return f(Space3{});
  }
  throw std::logic_error("unknown geometry");
}

/// Length [m] out of the plane that a point stands for, where the coordinate system is known at run time only.
template <class T>
KOKKOS_INLINE_FUNCTION T measure(Geometry geometry, const T* x) {
  return geometry == Geometry::axisymmetric ? Axisymmetric::measure(x) : T(1.0);
}

}  // namespace mudline
