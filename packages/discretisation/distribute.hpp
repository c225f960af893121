#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "discretisation/byte_stream.hpp"
#include "discretisation/mesh.hpp"

namespace mudline {

/// What one rank gets to know of the mesh: some facts of the whole, and its own part.
struct MeshPart {
  struct Block {
    std::string region;
    CellShape shape = CellShape::tri3;
    std::vector<long long> ids;
    std::vector<int> nodes;  // (element, node) local
    void transfer(ByteStream& s) { s(region)(shape)(ids)(nodes); }
  };

  long long num_global_nodes = 0, num_global_elements = 0;
  std::vector<std::string> regions;
  Bounds bounds;
  std::map<std::string, Bounds> region_bounds;

  int num_owned_nodes = 0;
  std::vector<long long> node_ids;  // owned ascending, then ghosts ascending
  std::vector<double> coordinates;  // (node, dimension)
  std::vector<char> is_vertex;      // (node)
  std::vector<Block> blocks;
  std::map<std::string, std::vector<Side>> side_sets;
  std::map<std::string, std::vector<int>> node_sets;
  std::map<std::string, std::vector<int>> set_nodes;  // of side and node sets

  void transfer(ByteStream& s) {
    s(num_global_nodes)(num_global_elements)(regions)(bounds)(region_bounds);
    s(num_owned_nodes)(node_ids)(coordinates)(is_vertex)(blocks)(side_sets)(node_sets)(set_nodes);
  }
};

/// The rank of every element, elements numbered over all blocks in order. Balanced by METIS on the dual graph; every
/// rank gets at least one. Throws InputError when there are more ranks than elements.
std::vector<int> partition_elements(const GlobalMesh& mesh, int ranks);

/// Cuts rank 0's mesh into parts and hands each rank its own, one after the other. Collective.
MeshPart distribute(const Teuchos::Comm<int>& comm, const GlobalMesh& mesh);

/// Throws InputError when the mesh cannot be computed on: no elements, mixed orders or dimensions, cells that are
/// not of the geometry's dimension, orphan nodes, overlapping or not matching elements, a Jacobian that is not
/// positive, a negative radius, an empty set, sets of the same name.
void check_mesh(const GlobalMesh& mesh, Geometry geometry);

}  // namespace mudline
