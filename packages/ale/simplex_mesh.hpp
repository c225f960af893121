#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ale/ghosted_mesh.hpp"

namespace mudline {

/// Triangles or tetrahedra from which a mesh is built: vertices, cells by block, and the mid-side nodes of curved
/// edges.
class SimplexMesh {
 public:
  using Ends = std::pair<int, int>;    // vertices
  using Corners = std::array<int, 4>;  // vertices; the fourth is -1 in the plane
  std::vector<Point> places;           // (vertex) [m]

  /// `blocks`: of the old mesh; the new one has the same regions and shapes.
  explicit SimplexMesh(const std::vector<ElementBlock>& blocks);
  /// A mesh of one region.
  SimplexMesh(const std::string& region, CellShape shape) : blocks_{{region, shape, {}}}, cells_(1) {}
  void add(int block, const Corners& corners) { cells_[block].push_back(corners); }
  /// Sets the place of an edge's mid-side node [m]; that of other edges is halfway between their ends.
  void bend(int a, int b, const Point& middle) { curved_[ascending(a, b)] = middle; }
  Point middle_place(int a, int b) const;

  /// The mesh without sets. Elements are ordered along a space-filling curve, by block, and nodes as the elements meet
  /// them, so that neighbours are close in memory.
  GlobalMesh number();
  // After number():
  const std::vector<std::vector<Corners>>& cells() const { return cells_; }
  long long node(int vertex) const { return nodes_.at(vertex); }
  long long middle(int a, int b) const { return mid_side_nodes_.at(ascending(a, b)); }
  /// In the plane: the sides of all cells, by their vertices in the direction that has the cell on the left.
  std::map<Ends, GlobalMesh::Side> sides() const;

 private:
  static Ends ascending(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
  void sort();
  long long number_of(int vertex, GlobalMesh& mesh);
  long long number_of_mid_side_node(int a, int b, GlobalMesh& mesh);

  std::vector<GlobalMesh::Block> blocks_;
  std::vector<std::vector<Corners>> cells_;  // (block)
  std::map<Ends, Point> curved_;
  std::map<int, long long> nodes_;
  std::map<Ends, long long> mid_side_nodes_;
};

}  // namespace mudline
