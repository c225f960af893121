#pragma once

#include <Kokkos_Core.hpp>

#include <array>

#include "discretisation/mesh.hpp"

namespace mudline {

/// How well the elements of a mesh are shaped.
struct MeshQuality {
  double lowest = 1;               // smallest scaled Jacobian, see ElementMap [-]
  Point place{};                   // centre of the element that has it
  long long poor = 0, folded = 0;  // elements below `doubtful`, and not above 0
  static constexpr double doubtful = 0.1;
};

/// Of the mesh with its nodes at x (local node, dimension) [m], the same on every rank. Collective.
MeshQuality mesh_quality(const Mesh& mesh, const Kokkos::View<const double**, Kokkos::LayoutRight>& x);

}  // namespace mudline
