#pragma once

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "framework/space.hpp"
#include "framework/state.hpp"

namespace mudline {

constexpr int place_size = 3;          // coordinates of a node; in the plane the third is 0
using Positions = std::vector<Point>;  // [m] by global node

/// A place of a mesh in the plane.
inline Point on_plane(const std::array<double, 2>& place) { return {place[0], place[1], 0}; }
/// [m]
inline double distance(const Point& a, const Point& b) {
  return std::hypot(std::hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/// The whole mesh on every rank, by global numbers. Mesh motion and remap are worked out on it by every rank alike, so
/// their results do not depend on the number of ranks; a mesh of 10^5 elements takes some 20 MB.
class WholeMesh {
 public:
  struct Element {
    CellShape shape;
    int block;
    std::array<int, 27> nodes;      // global ids
    std::array<int, 6> neighbours;  // element across each side; -1: none
  };
  struct ElementSide {
    int element, side;
  };

  /// Collective.
  explicit WholeMesh(const Mesh& mesh);

  const Mesh& mesh() const { return mesh_; }
  int num_nodes() const { return static_cast<int>(mesh_.num_global_nodes()); }
  /// 2 or 3.
  int dimension() const { return mesh_.dimension(); }
  const std::vector<Element>& elements() const { return elements_; }
  const std::map<std::string, std::vector<ElementSide>>& side_sets() const { return side_sets_; }
  const std::map<std::string, std::vector<int>>& node_sets() const { return node_sets_; }
  /// One element of every node.
  int element_of(int node) const { return element_of_[node]; }
  bool is_vertex(int node) const { return vertex_[node] != 0; }
  /// Whether a node is on the boundary of a region: on that of the mesh, or between two regions.
  bool on_boundary(int node) const { return on_boundary_[node] != 0; }
  /// Whether a side of an element is.
  bool on_boundary(const Element& element, int side) const {
    const int other = element.neighbours[side];
    return other < 0 || elements_[other].block != element.block;
  }

  /// Positions of all nodes from every rank's own ones. Collective.
  Positions gather(const ConstCoordinateView& x) const;
  /// This rank's nodes, owned and ghost.
  void scatter(const Positions& from, const CoordinateView& to) const;

  /// One value per owned dof of a field as (node, component) of the whole mesh; nodes without the field hold 0.
  /// Collective.
  std::vector<double> gather(const Space& space, int field, const ConstNodalView& values) const;
  void scatter(const Space& space, int field, const std::vector<double>& from, const NodalView& to) const;

  /// Rows of a block's point array, element after element in global order: (first_row(e) + q, columns). Collective.
  std::vector<double> gather_points(int block, int points, const ConstPointView& rows) const;
  /// Row of an element's first point in what gather_points returns, in units of rows.
  int first_row(int element, int points) const { return place_in_block_[element] * points; }
  /// Global numbers of a block's elements.
  const std::vector<int>& block_elements(int block) const { return block_elements_[block]; }

 private:
  const Mesh& mesh_;
  std::vector<Element> elements_;
  std::vector<std::vector<int>> block_elements_;
  std::vector<int> place_in_block_, element_of_;
  std::vector<char> vertex_, on_boundary_;
  std::map<std::string, std::vector<ElementSide>> side_sets_;
  std::map<std::string, std::vector<int>> node_sets_;
};

}  // namespace mudline
