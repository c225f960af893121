#pragma once

#include <stdexcept>

#include "discretisation/mesh.hpp"

namespace mudline {

/// Refuses, where it stands in the deck, a type that needs Gmsh in a program that was built without.
inline void refuse_without_gmsh(const Parameters& p) {
  if (p.documenting()) return;
  const Section section = p.deck();
  section.fail("'" + section.text("type") + "' needs Gmsh, and this program was built without it (MUDLINE_GMSH=OFF)",
               "type");
}

/// What "gmsh" is in such a program.
class MeshWithoutGmsh : public MeshSource {
 public:
  void parameters(Parameters& p) { refuse_without_gmsh(p); }
  GlobalMesh generate() const override { throw std::logic_error("there is no Gmsh"); }
};

}  // namespace mudline
