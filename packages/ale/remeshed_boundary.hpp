#pragma once

#include "ale/remesher.hpp"
#include "ale/surface_remesher.hpp"

namespace mudline {

/// The boundary of the regions of a mesh in space, meshed anew, with its nodes where they are.
struct RemeshedBoundary {
  struct MidSideNode {
    std::array<int, 2> ends;  // vertices
    Point place;              // [m]
    int node;                 // the old node that it is; -1: a new one
  };
  RemeshedSurface mesh;
  Positions places;                         // (vertex) [m]
  std::vector<MidSideNode> mid_side_nodes;  // of all edges, where faces are quadratic
};

/// Old nodes that stay are where they are at x, to the last bit; others are on the faces and curves at x, and keep the
/// gap to bodies.
RemeshedBoundary remeshed_boundary(const Remesher& plan, const Positions& x, const State& state);

}  // namespace mudline
