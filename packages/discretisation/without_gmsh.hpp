#pragma once

#include "core/parameters.hpp"

namespace mudline {

/// Refuses, where it stands in the deck, a type that needs Gmsh in a program that was built without.
inline void refuse_without_gmsh(const Parameters& p) {
  if (p.documenting()) return;
  const Section section = p.deck();
  section.fail("'" + section.text("type") + "' needs Gmsh, and this program was built without it (MUDLINE_GMSH=OFF)",
               "type");
}

}  // namespace mudline
