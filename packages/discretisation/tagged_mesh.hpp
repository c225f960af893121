#pragma once

#include <map>
#include <string>
#include <vector>

#include "discretisation/byte_stream.hpp"
#include "discretisation/mesh.hpp"

namespace mudline {

/// A mesh of one dimension (2 or 3) as a file for Gmsh holds it: nodes by the file's own numbers, elements by Gmsh's
/// types and in its order of nodes, each with the name of its physical group.
struct TaggedMesh {
  using Tag = long long;
  struct Node {
    Tag tag;
    Point place;  // [m]
  };
  /// Elements of the mesh's dimension, of one type and one entity of the geometry.
  struct Cells {
    int type;
    std::string region, entity;  // "clay", "surface 1"; no region: they are in no group
    std::vector<Tag> nodes;      // (element, node)
    void transfer(ByteStream& s) { s(type)(region)(entity)(nodes); }
  };
  /// Lines or faces of one group.
  struct Sides {
    std::string set;
    int corners;
    std::vector<Tag> nodes;  // (side, corner)
    void transfer(ByteStream& s) { s(set)(corners)(nodes); }
  };
  std::vector<Node> nodes;
  std::vector<Cells> cells;
  std::vector<Sides> sides;
  std::map<std::string, std::vector<Tag>> points, curves;  // nodes in groups of points, and in space of curves
  void transfer(ByteStream& s) { s(nodes)(cells)(sides)(points)(curves); }
};

/// The mesh, with elements of the given order and dimension. Elements are sorted along a space-filling curve and nodes
/// in the order in which elements use them, so that neighbours are close in memory; nodes of no element are dropped;
/// clockwise elements, and those of space with a negative volume, are turned over. Quadrilaterals of 8 nodes and
/// hexahedra of 20 get the centres that they lack (centre_nodes.hpp); prisms of 15 do so in a mesh that has hexahedra
/// of second order or prisms of 18 nodes. Throws InputError without a position.
GlobalMesh global_mesh(const TaggedMesh& tagged, int order, int dimension);

/// "12 quadrilaterals of 8 nodes", where such elements get centres; "" where there are none.
std::string elements_without_centres(const TaggedMesh& tagged);

}  // namespace mudline
