#pragma once

#include <Kokkos_Core.hpp>

#include <array>

#include "discretisation/mesh.hpp"

namespace mudline {

/// How well the elements of a mesh are shaped.
struct MeshQuality {
  double lowest = 1;               // smallest scaled Jacobian, see ElementMap [-]
  Point place{};                   // centre of that element [m]
  long long poor = 0, folded = 0;  // number of elements below `doubtful`, and of those not above 0
  static constexpr double doubtful = 0.1;
};

/// Quality of the mesh with its nodes at x (local node, dimension) [m], the same on every rank. Collective.
MeshQuality mesh_quality(const Mesh& mesh, const Kokkos::View<const double**, Kokkos::LayoutRight>& x);

}  // namespace mudline
