#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "discretisation/element_map.hpp"
#include "discretisation/mesh.hpp"

namespace mudline {

/// The corners of a side in a form that two sides can be compared by; -1 where there are fewer than four.
using SideKey = std::array<long long, 4>;
/// By number: the same for the two elements at a side, and for whatever way round it is given.
SideKey sorted_key(const long long* corners, int count);
/// As they go round, the lowest first (in the plane as they are): the same for one way round only.
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
      const std::vector<int> local = side_nodes(block.shape, s);
      std::vector<long long> nodes(local.size());
      for (std::size_t e = 0; e < block.nodes.size() / n; ++e) {
        for (std::size_t a = 0; a < local.size(); ++a) nodes[a] = block.nodes[e * n + local[a]];
        f(GlobalMesh::Side{static_cast<int>(b), static_cast<long long>(e), s}, nodes);
      }
    }
  }
}
/// How many sides (num_sides) or edges (num_edges) all elements have together.
std::size_t count_over_elements(const GlobalMesh& mesh, int (*per_element)(CellShape));

/// Sides that no second element shares: the boundary, outer and inner.
std::vector<ElementSide> boundary_sides(const GlobalMesh& mesh);

ElementMap element_map(const GlobalMesh& mesh, int block, long long element);
Point middle_of(const GlobalMesh& mesh, const ElementSide& side);
/// "(0.1, -2)", in space with three numbers.
std::string place_text(const Point& point, int dimension);

/// Throws InputError where elements of a whole mesh lie on each other or beside each other without being joined:
/// hanging nodes, twin nodes, meshes that do not match or lie over one another, holes that no set names. Surfaces that
/// may touch (mesh.contacts.pairs) are let pass, and the side sets `cracks` along cracks that are meant, which must be
/// there. Sides are looked at in some points, nearer than a fiftieth of their elements' size. In space this does not
/// find elements that have a face beside a part of another one that is smaller than about a tenth of it, overlaps
/// thinner than that fiftieth, and a hole whose faces meet those of another void along an edge in such a way that its
/// own do not close around it.
void check_seams(const GlobalMesh& mesh, const std::vector<std::string>& cracks);

/// The parts of a distributed mesh, each of which hangs together by common nodes.
struct MeshParts {
  std::vector<Point> places;                       // a node of each
  std::vector<int> of_node;                        // of this rank, by local node
  std::map<std::string, std::vector<int>> of_set;  // the parts that have a node in a set
};
/// Collective.
MeshParts mesh_parts(const Mesh& mesh);

/// Fails as require_side_set() does, and where a side of the set lies between two elements: loads and contacts act on
/// the boundary. Collective.
void require_boundary(const Mesh& mesh, const Section& section, const std::string& entry, const std::string& name);

}  // namespace mudline
