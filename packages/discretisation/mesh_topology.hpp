#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "discretisation/element_map.hpp"
#include "discretisation/mesh.hpp"

namespace mudline {

/// The corners of a side as a key to compare sides by; unused places are -1.
using SideKey = std::array<long long, 4>;
/// Key of the corners sorted by number: the same for both elements at a side, and for either orientation.
SideKey sorted_key(const long long* corners, int count);
/// Key of the corners in their cyclic order, the lowest first (in the plane in the given order): it differs between the
/// two orientations.
SideKey directed_key(const long long* corners, int count);
/// The directed key of the same side seen from the other element.
SideKey reversed_key(const SideKey& directed);
struct SideKeyHash {
  std::size_t operator()(const SideKey& key) const;
};

/// A side of one element of a whole mesh. In the plane it runs from corner to corner with the element on its left; in
/// space its corners go round counter-clockwise as seen from outside of the element.
struct ElementSide {
  GlobalMesh::Side place;
  std::vector<long long> nodes;  // in the order of the side's own shape
};

/// Calls f(place, nodes) for every side of every element; nodes: in the order of the side's own shape.
template <class F>
void for_each_side(const GlobalMesh& mesh, F&& f) {
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const auto& block = mesh.blocks[b];
    const std::size_t n = num_nodes(block.shape);
    for (int s = 0; s < num_sides(block.shape); ++s) {
      const std::vector<int>& local = side_nodes(block.shape, s);
      std::vector<long long> nodes(local.size());
      for (std::size_t e = 0; e < block.nodes.size() / n; ++e) {
        for (std::size_t a = 0; a < local.size(); ++a) nodes[a] = block.nodes[e * n + local[a]];
        f(GlobalMesh::Side{static_cast<int>(b), static_cast<long long>(e), s}, nodes);
      }
    }
  }
}
/// Total number of sides (num_sides) or edges (num_edges) over all elements.
std::size_t count_over_elements(const GlobalMesh& mesh, int (*per_element)(CellShape));

/// Sides that no second element shares: the boundary, outer and inner.
std::vector<ElementSide> boundary_sides(const GlobalMesh& mesh);

ElementMap element_map(const GlobalMesh& mesh, int block, long long element);
Point middle_of(const GlobalMesh& mesh, const ElementSide& side);

/// Throws InputError where elements of a whole mesh overlap, or lie beside each other without being joined: hanging
/// nodes, twin nodes, meshes that do not match or overlap, holes that no set names. Surfaces that may touch
/// (mesh.contacts.pairs) are allowed, and so are the side sets `cracks` along intended cracks, which must exist. Sides
/// lie beside each other where sample points of theirs are nearer than a fiftieth of their elements' size. In space
/// this does not find elements that have a face beside a part of another one that is smaller than about a tenth of it,
/// overlaps thinner than that fiftieth, and a hole whose faces meet those of another void along an edge so that its own
/// do not close around it.
void check_seams(const GlobalMesh& mesh, const std::vector<std::string>& cracks);

/// The connected parts of a distributed mesh: elements with common nodes are connected.
struct MeshParts {
  std::vector<Point> places;                       // position of one node of each part [m]
  std::vector<int> of_node;                        // (local node) its part
  std::map<std::string, std::vector<int>> of_set;  // the parts that have a node in a set
};
/// Finds the connected parts of a mesh. Collective.
MeshParts mesh_parts(const Mesh& mesh);

/// Throws InputError as require_side_set() does, and where a side of the set lies between two elements, because loads
/// and contacts act on the boundary. Collective.
void require_boundary(const Mesh& mesh, const Section& section, const std::string& entry, const std::string& name);

}  // namespace mudline
