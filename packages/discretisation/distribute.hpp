#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "discretisation/byte_stream.hpp"
#include "discretisation/mesh.hpp"

namespace mudline {

/// The mesh data that one rank receives: some facts of the whole mesh, and its own part.
struct MeshPart {
  struct Block {
    std::string region;
    CellShape shape = CellShape::tri3;
    std::vector<long long> ids;
    std::vector<int> nodes;  // (element, node) local
    template <class Archive>
    void transfer(Archive& to) {
      to("region", region)("shape", shape)("ids", ids)("nodes", nodes);
    }
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
  std::map<std::string, std::vector<int>> set_nodes;  // local nodes of the side sets and node sets

  template <class Archive>
  void transfer(Archive& to) {
    to("global nodes", num_global_nodes)("global elements", num_global_elements)("regions", regions);
    to("bounds", bounds)("region bounds", region_bounds)("owned nodes", num_owned_nodes)("node ids", node_ids);
    to("coordinates", coordinates)("is vertex", is_vertex)("blocks", blocks);
    to("side sets", side_sets)("node sets", node_sets)("nodes of sets", set_nodes);
  }
};

/// The rank of every element, elements numbered over all blocks in order. METIS balances the dual graph, where the
/// weight of an element is its number of nodes and a side in contact weighs as much as two elements; every rank gets at
/// least one element. Throws InputError when there are more ranks than elements.
std::vector<int> partition_elements(const GlobalMesh& mesh, int ranks);

/// Cuts a whole mesh into one part per rank, one at a time.
class MeshCutter {
 public:
  /// `mesh` must outlive the cutter.
  MeshCutter(const GlobalMesh& mesh, int ranks);
  MeshPart part(int rank);

 private:
  void describe_whole();
  void number_nodes(int rank, MeshPart& part);
  void add_elements(int rank, MeshPart& part) const;
  void add_sets(int rank, MeshPart& part) const;
  void add_partners();
  std::vector<int> local(const std::vector<long long>& sorted_nodes, const MeshPart& part) const;

  const GlobalMesh& mesh_;
  std::vector<long long> offsets_;                        // first element of each block, and the end
  std::vector<int> rank_of_, place_;                      // (element): its rank, and its number in its block there
  std::vector<std::vector<long long>> elements_of_rank_;  // ascending
  std::vector<std::vector<long long>> nodes_of_rank_;     // sorted
  std::vector<int> owners_, local_;                       // (node): owner; number on the rank being cut
  std::vector<char> is_vertex_;                           // (node)
  std::map<std::string, std::vector<long long>> set_nodes_;
  MeshPart whole_;
};

/// Cuts rank 0's mesh into parts and sends each rank its own, one after the other. Collective.
MeshPart distribute(const Teuchos::Comm<int>& comm, const GlobalMesh& mesh);

/// Throws InputError when the mesh cannot be used: no elements, mixed orders or dimensions, cells that are not of the
/// geometry's dimension, orphan nodes, elements that overlap or do not match, a Jacobian that is not positive, a
/// negative radius, an empty set, sets of the same name.
void check_mesh(const GlobalMesh& mesh, Geometry geometry);

}  // namespace mudline
