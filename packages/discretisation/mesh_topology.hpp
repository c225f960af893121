#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "discretisation/element_map.hpp"
#include "discretisation/mesh.hpp"

namespace mudline {

/// A side of one element of a whole mesh, from corner to corner with the element on its left.
struct ElementSide {
  GlobalMesh::Side place;
  std::vector<long long> nodes;  // two corners, then the middle of a quadratic side
};

/// Sides that no second element shares: the boundary, outer and inner.
std::vector<ElementSide> boundary_sides(const GlobalMesh& mesh);

ElementMap element_map(const GlobalMesh& mesh, int block, long long element);
std::array<double, 2> middle_of(const GlobalMesh& mesh, const ElementSide& side);
/// "(0.1, -2)".
std::string place_text(const std::array<double, 2>& point);

/// Throws InputError where elements of a whole mesh lie on each other or beside each other without being joined:
/// hanging nodes, twin nodes, meshes that do not match or lie over one another, holes that no set names. Surfaces that
/// may touch (mesh.pairs) are let pass, and the side sets `cracks` along cracks that are meant, which must be there.
void check_seams(const GlobalMesh& mesh, const std::vector<std::string>& cracks);

/// The parts of a distributed mesh, each of which hangs together by common nodes.
struct MeshParts {
  std::vector<std::array<double, 2>> places;       // a node of each [m]
  std::map<std::string, std::vector<int>> of_set;  // the parts that have a node in a set
};
/// Collective.
MeshParts mesh_parts(const Mesh& mesh);

/// Fails as require_side_set() does, and where a side of the set lies between two elements: loads and contacts act on
/// the boundary. Collective.
void require_boundary(const Mesh& mesh, const Section& section, const std::string& entry, const std::string& name);

}  // namespace mudline
