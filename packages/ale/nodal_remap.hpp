#pragma once

#include <vector>

#include "ale/mesh_paths.hpp"

namespace mudline {

/// How the values at the nodes of the old mesh make those at the moved nodes: rows of a sparse interpolation, by the
/// shape functions of the field in the old mesh. The values of nodes on paths come from the boundary alone, so that
/// what is prescribed along it stays as it is; nodes that did not move keep theirs to the last bit.
class NodalRemap {
 public:
  NodalRemap(const WholeMesh& mesh, const std::vector<MeshPath>& paths, const Positions& x_old, const Positions& x_new);
  /// `support`: which nodes carry the field; (node, component) in and out. `limited`: no value beyond those it is made
  /// of, for fields that jump from one node to the next, where quadratic shape functions overshoot remap by remap;
  /// smooth fields lose their peaks by it.
  std::vector<double> apply(const std::vector<double>& old, int components, Support support,
                            bool limited = false) const;

 private:
  struct Place {
    int element = -1;  // -1: the node did not move
    double xi[2] = {0, 0};
    int side_nodes[3] = {-1, -1, -1};  // of the old boundary, for nodes on paths: ends, middle or -1
    double along = 0;
  };
  const WholeMesh& mesh_;
  std::vector<Place> places_;
};

}  // namespace mudline
