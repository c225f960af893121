#pragma once

#include <string>

#include "discretisation/mesh.hpp"

namespace mudline {

/// Writes a mesh that is all on this rank as a file of Gmsh's format 2.2, with its regions and sets as physical groups.
/// `x`: places of its nodes [m]. RunError where the file cannot be written.
void write_msh(const Mesh& mesh, const Kokkos::View<const double**, Kokkos::LayoutRight>& x, const std::string& path);

}  // namespace mudline
