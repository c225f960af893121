#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "ale/closest_on_side.hpp"

namespace mudline {

/// A chain of element sides along the boundary of a region from one corner to the next; its nodes may slide along it.
struct MeshPath {
  std::vector<int> nodes;      // in order; with quadratic elements every second one is a mid-side node
  int stride;                  // 2 with mid-side nodes, 1 without
  std::set<std::string> sets;  // side sets that all its sides belong to
  bool outer = true;           // on the boundary of the mesh, not between two regions
  bool material = false;       // its nodes stay material points; see BoundaryMotion

  int num_vertices() const { return static_cast<int>(nodes.size() - 1) / stride + 1; }
  /// Whether nodes between its ends may slide.
  bool slides() const { return num_vertices() > 2 && !material; }
  /// The side that begins at this one of its nodes.
  CurvedSide side(int first) const;
};

/// All boundaries of the mesh's regions, split into paths. A path ends where regions meet, where the side sets change,
/// at the nodes `corners`, and where the boundary of the source's mesh turns by more than
/// `corner_angle` [rad] and does not lie on a body there (`on_body` of a node; asked only where it turns): such a bend
/// belongs to the body, and the soil slides past it. The ends of paths are material points.
std::vector<MeshPath> find_paths(
    const GhostedMesh& mesh, const Positions& source, const std::set<int>& corners, double corner_angle,
    const std::function<bool(int node)>& on_body = [](int) { return false; });

}  // namespace mudline
