#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "algebra/types.hpp"
#include "framework/space.hpp"
#include "framework/state.hpp"
#include "tensor/vec.hpp"

namespace mudline {

constexpr int place_size = 3;          // coordinates of a node; in the plane the third is 0
using Positions = std::vector<Point>;  // [m] by node of a GhostedMesh

/// A point in the plane as a position.
inline Point on_plane(const Vec<double, 2>& place) { return {place[0], place[1], 0}; }
/// [m]
inline double distance(const Point& a, const Point& b) {
  return std::hypot(std::hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

class Neighbourhood;

/// This rank's elements, some layers of those of other ranks around them (ghosts), and on every rank the nodes of the
/// boundaries of all regions. Local numbers ascend with the global ones: loops meet the elements around a node in the
/// same order on any number of ranks, so that sums agree to the last digit. On one rank they are the global numbers.
class GhostedMesh {
 public:
  static constexpr int whole = std::numeric_limits<int>::max();  // layers: all of the mesh
  static constexpr int outside = -1, unknown = -2;               // no neighbour; one that this rank does not have
  struct Element {
    CellShape shape;
    int block;
    std::array<int, 27> nodes;
    std::array<int, 6> neighbours;  // element across each side, outside or unknown
  };
  struct ElementSide {
    int element, side;
  };
  /// A side on the boundary of a region.
  struct BoundarySide {
    CellShape shape;
    int block, other;            // block of its element, and of the one across; -1: on the boundary of the mesh
    std::vector<int> nodes;      // in the order of the side's shape
    std::set<std::string> sets;  // side sets that it belongs to
    bool first = true;           // it is the first of the two coincident sides between regions
  };

  /// Boxes near which a rank needs all elements, whichever rank owns them; x: positions of the mesh's nodes.
  struct Wanted {
    ConstCoordinateView x;
    std::vector<Bounds> boxes;
  };

  /// Collective. `near`: boxes whose elements come as well; the neighbours beyond these are unknown.
  explicit GhostedMesh(const Mesh& mesh, int layers = whole, const Wanted* near = nullptr);

  const Mesh& mesh() const { return mesh_; }
  int layers() const { return layers_; }
  /// 2 or 3.
  int dimension() const { return mesh_.dimension(); }
  int num_nodes() const { return static_cast<int>(node_ids_.size()); }
  long long node_id(int node) const { return node_ids_[node]; }
  /// The node of a global number that this rank has.
  int local_node(long long id) const;
  /// Nodes that this rank owns, ascending.
  const std::vector<int>& owned_nodes() const { return owned_nodes_; }
  bool owns(int node) const { return owned_[node] != 0; }
  /// Whether this rank has all elements around a node.
  bool is_complete(int node) const { return complete_[node] != 0; }
  bool is_vertex(int node) const { return vertex_[node] != 0; }
  /// Whether a node is on the boundary of a region: on that of the mesh, or between two regions.
  bool on_boundary(int node) const { return on_boundary_[node] != 0; }
  /// Whether a side of an element is on the boundary of a region, as far as this rank knows.
  bool on_boundary(const Element& element, int side) const {
    const int other = element.neighbours[side];
    return other == outside || (other >= 0 && elements_[other].block != element.block);
  }
  /// One element that has the node; where the node is complete, the first of the whole mesh.
  int element_of(int node) const { return element_of_[node]; }

  const std::vector<Element>& elements() const { return elements_; }
  /// A block's elements, ghosts among them.
  const std::vector<int>& block_elements(int block) const { return block_elements_[block]; }
  /// A block's elements that are this rank's own, in the mesh's order.
  const std::vector<int>& own_elements(int block) const { return own_elements_[block]; }
  const std::map<std::string, std::vector<ElementSide>>& side_sets() const { return side_sets_; }
  /// Node sets of the whole mesh: their nodes are on every rank.
  const std::map<std::string, std::vector<int>>& node_sets() const { return node_sets_; }
  /// Boundary sides of the whole mesh, in the order of elements.
  const std::vector<BoundarySide>& boundary() const { return boundary_; }

  /// Positions from the mesh's nodes. Collective.
  Positions gather(const ConstCoordinateView& x) const;
  /// Sets the coordinates of the nodes that the mesh has on this rank.
  void scatter(const Positions& from, const CoordinateView& to) const;
  /// A field by (node, component); nodes without the field hold 0. Collective.
  std::vector<double> gather(const Space& space, int field, const ConstNodalView& values) const;
  void scatter(const Space& space, int field, const std::vector<double>& from, const NodalView& to) const;
  /// Values by (node of the mesh, component), of which those of owned nodes count, by (node, component). Collective.
  std::vector<double> gather_nodes(const std::vector<double>& values, int components) const;
  /// Number here of a local node of the mesh.
  int number_of(int node_of_mesh) const { return of_mesh_[node_of_mesh]; }
  /// Rows of a block's point array: (first_row(e) + q, columns). Collective.
  std::vector<double> gather_points(int block, int points, const ConstPointView& rows) const;
  /// Row of an element's first point in what gather_points returns.
  int first_row(int element, int points) const { return place_in_block_[element] * points; }

  /// Sets all nodes to the values of their owners: values by (node, component); entries beyond the nodes do not change.
  /// Collective.
  void fill(std::vector<double>& values, int components) const;
  void fill(Positions& x) const;
  /// Sets all points of a block to the values of their owners: table by (row, column). Collective.
  void fill_points(int block, int points, int columns, std::vector<double>& table) const;

  /// Sum over all ranks, in extended precision, so that it hardly ever depends on the number of ranks.
  double sum(long double mine) const;
  double largest(double mine) const;
  double smallest(double mine) const { return -largest(-mine); }
  bool any(bool mine) const { return largest(mine ? 1.0 : 0.0) > 0; }

 private:
  struct Exchange {
    RCP<const Map> from;
    RCP<const Import> import;  // null: there is nothing to exchange
  };
  Exchange exchange(const std::vector<long long>& own, const std::vector<long long>& all) const;
  // Steps of the constructor, in their order.
  struct Numbers;
  void add_elements(const Neighbourhood& around, Numbers& numbers);
  void find_own_elements(const Numbers& numbers);
  /// Collective, like the next one and the last two.
  void gather_boundary(Numbers& numbers) const;
  void gather_node_sets(Numbers& numbers) const;
  void number_nodes(const Numbers& numbers);
  void add_boundary(const Numbers& numbers);
  void make_exchanges(const Numbers& numbers);
  void add_side_set(const std::string& name);
  void fill(const Exchange& exchange, const std::vector<int>& own, int width, double* values) const;

  const Mesh& mesh_;
  int layers_;
  std::vector<long long> node_ids_;
  std::vector<int> of_mesh_, owned_nodes_;  // (the mesh's node) node here; ascending
  std::vector<char> owned_, complete_, vertex_, on_boundary_;
  std::vector<Element> elements_;
  std::vector<std::vector<int>> block_elements_, own_elements_;
  std::vector<int> place_in_block_, element_of_;
  std::map<std::string, std::vector<ElementSide>> side_sets_;
  std::map<std::string, std::vector<int>> node_sets_;
  std::vector<BoundarySide> boundary_;
  Exchange nodes_;
  std::vector<Exchange> points_;              // (block) by element
  std::vector<std::vector<int>> own_places_;  // (block) place in the block of each own element
};

/// Widens a box by an element's nodes.
inline void enclose(Bounds& box, const GhostedMesh::Element& element, const Positions& x) {
  for (int a = 0; a < num_nodes(element.shape); ++a) box.enclose(x[element.nodes[a]]);
}

}  // namespace mudline
