#pragma once

#include <vector>

#include "ale/ghosted_mesh.hpp"

namespace mudline {

/// The nodes that may move, complete ghosts among them, by colours: no two of a colour are in one element, so that all
/// of a colour may be placed at once, on any number of ranks with the same result (Jones & Plassmann 1993). `movable`:
/// (node). Collective.
std::vector<std::vector<int>> vertex_colours(const GhostedMesh& mesh, const std::vector<char>& movable);

}  // namespace mudline
