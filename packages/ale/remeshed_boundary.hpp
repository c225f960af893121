#pragma once

#include "ale/remesher.hpp"
#include "ale/surface_remesher.hpp"

namespace mudline {

/// The remeshed boundary of the regions of a mesh in space, with the places of its nodes.
struct RemeshedBoundary {
  struct MidSideNode {
    std::array<int, 2> ends;  // vertices
    Point place;              // [m]
    int node;                 // the old node that stays here; -1: it is a new one
  };
  RemeshedSurface mesh;
  Positions places;                         // (vertex) [m]
  std::vector<MidSideNode> mid_side_nodes;  // of all edges; empty where faces are linear
};

/// Remeshes the boundary. Old nodes that stay keep their place x to the last bit; others are put on the faces and
/// curves at x, with the gap to bodies there.
RemeshedBoundary remeshed_boundary(const Remesher& plan, const Positions& x, const State& state);

}  // namespace mudline
