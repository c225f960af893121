#pragma once

#include <vector>

#include "ale/ghosted_mesh.hpp"

namespace mudline {

/// The movable nodes, complete ghosts included, by colour: no two of a colour share an element, so that all of a colour
/// may be placed at once, with the same result on any number of ranks (Jones & Plassmann 1993). `movable`: (node).
/// Collective.
std::vector<std::vector<int>> vertex_colours(const GhostedMesh& mesh, const std::vector<char>& movable);

}  // namespace mudline
