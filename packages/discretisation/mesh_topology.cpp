#include "discretisation/mesh_topology.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <unordered_map>

namespace mudline {

namespace {

/// Calls f(place, nodes) for every side of every element.
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

using Key = unsigned long long;

/// How many elements have a side between two nodes, whatever its direction.
class SideCount {
 public:
  explicit SideCount(const GlobalMesh& mesh) : nodes_(mesh.coordinates.size()) {
    for_each_side(mesh, [&](const GlobalMesh::Side&, const std::vector<long long>& n) { ++count_[key(n)]; });
  }
  int operator()(const std::vector<long long>& nodes) const { return count_.at(key(nodes)); }

 private:
  Key key(const std::vector<long long>& n) const { return std::min(n[0], n[1]) * nodes_ + std::max(n[0], n[1]); }
  Key nodes_;
  std::unordered_map<Key, int> count_;
};

template <class T>
std::vector<T> reduced(const Mesh& mesh, Teuchos::EReductionType how, const std::vector<T>& local) {
  std::vector<T> result(local.size());
  if (!local.empty())
    Teuchos::reduceAll(*mesh.comm(), how, static_cast<int>(local.size()), local.data(), result.data());
  return result;
}

/// The lowest node of the whole mesh that each node hangs together with.
std::vector<int> leaders(const Mesh& mesh) {
  std::vector<int> leader(mesh.num_global_nodes());
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&](int node) {
    while (leader[node] != node) node = leader[node] = leader[leader[node]];
    return node;
  };
  const auto join = [&](long long a, long long b) {
    const int one = find(static_cast<int>(a)), other = find(static_cast<int>(b));
    leader[std::max(one, other)] = std::min(one, other);
  };
  for (const ElementBlock& block : mesh.blocks())
    for (int e = 0; e < block.num_elements; ++e)
      for (int a = 1; a < num_nodes(block.shape); ++a)
        join(mesh.node_ids()[block.nodes(e, 0)], mesh.node_ids()[block.nodes(e, a)]);
  for (;;) {  // what one rank knows is told to the others until nothing changes
    for (std::size_t node = 0; node < leader.size(); ++node) leader[node] = find(static_cast<int>(node));
    const std::vector<int> own = leader, lowest = reduced(mesh, Teuchos::REDUCE_MIN, leader);
    std::vector<int> changed{own != lowest};
    for (std::size_t node = 0; node < own.size(); ++node) join(own[node], lowest[node]);
    if (reduced(mesh, Teuchos::REDUCE_MAX, changed)[0] == 0) return leader;
  }
}

/// The sides of a set on all ranks, in a common order.
struct SetSides {
  std::vector<long long> ends;  // (side, 2) nodes of the whole mesh
  std::vector<double> middles;  // (side, 2) [m]
};

SetSides all_sides(const Mesh& mesh, const std::string& set) {
  const std::vector<Side>& own = mesh.side_sets().at(set);
  std::vector<int> counts(mesh.comm()->getSize(), 0);
  counts[mesh.comm()->getRank()] = static_cast<int>(own.size());
  counts = reduced(mesh, Teuchos::REDUCE_SUM, counts);
  const int all = std::accumulate(counts.begin(), counts.end(), 0);
  int row = std::accumulate(counts.begin(), counts.begin() + mesh.comm()->getRank(), 0);
  SetSides result{std::vector<long long>(2 * all, 0), std::vector<double>(2 * all, 0.0)};
  for (const Side& side : own) {
    const ElementBlock& block = mesh.blocks()[side.block];
    const std::vector<int> local = side_nodes(block.shape, side.side);
    for (int i = 0; i < 2; ++i) {
      result.ends[2 * row + i] = mesh.node_ids()[block.nodes(side.element, local[i])];
      for (int end = 0; end < 2; ++end)
        result.middles[2 * row + i] += 0.5 * mesh.coordinates()(block.nodes(side.element, local[end]), i);
    }
    ++row;
  }
  return {reduced(mesh, Teuchos::REDUCE_SUM, result.ends), reduced(mesh, Teuchos::REDUCE_SUM, result.middles)};
}

}  // namespace

std::vector<ElementSide> boundary_sides(const GlobalMesh& mesh) {
  const SideCount count(mesh);
  std::vector<ElementSide> result;
  for_each_side(mesh, [&](const GlobalMesh::Side& place, const std::vector<long long>& nodes) {
    if (count(nodes) == 1) result.push_back({place, nodes});
  });
  return result;
}

ElementMap element_map(const GlobalMesh& mesh, int block, long long element) {
  const CellShape shape = mesh.blocks[block].shape;
  const long long* nodes = mesh.blocks[block].nodes.data() + element * num_nodes(shape);
  return {shape, [&](int a) { return mesh.coordinates[nodes[a]]; }};
}

MeshParts mesh_parts(const Mesh& mesh) {
  const std::vector<int> leader = leaders(mesh);
  MeshParts result;
  std::vector<int> number(leader.size(), -1);
  std::vector<double> places;
  for (std::size_t node = 0; node < leader.size(); ++node)
    if (leader[node] == static_cast<int>(node)) {
      number[node] = static_cast<int>(result.places.size());
      result.places.emplace_back();
    }
  places.assign(2 * result.places.size(), 0.0);
  for (int node = 0; node < mesh.num_owned_nodes(); ++node) {
    const int part = number[mesh.node_ids()[node]];
    for (int i = 0; part >= 0 && i < 2; ++i) places[2 * part + i] = mesh.coordinates()(node, i);
  }
  places = reduced(mesh, Teuchos::REDUCE_SUM, places);
  for (std::size_t part = 0; part < result.places.size(); ++part)
    result.places[part] = {places[2 * part], places[2 * part + 1]};
  for (const std::string& name : mesh.set_names()) {
    std::vector<int> touched(result.places.size(), 0);
    for (int node : mesh.nodes_of_set(name)) touched[number[leader[mesh.node_ids()[node]]]] = 1;
    touched = reduced(mesh, Teuchos::REDUCE_MAX, touched);
    auto& parts = result.of_set[name];
    for (std::size_t part = 0; part < touched.size(); ++part)
      if (touched[part]) parts.push_back(static_cast<int>(part));
  }
  return result;
}

void require_boundary(const Mesh& mesh, const Section& section, const std::string& entry, const std::string& name) {
  require_side_set(mesh, section, entry, name);
  const SetSides sides = all_sides(mesh, name);
  std::map<std::pair<long long, long long>, int> row;
  const auto key = [](long long a, long long b) { return std::pair{std::min(a, b), std::max(a, b)}; };
  for (std::size_t k = 0; k < sides.ends.size() / 2; ++k)
    row[key(sides.ends[2 * k], sides.ends[2 * k + 1])] = static_cast<int>(k);
  std::vector<int> elements(sides.ends.size() / 2, 0);
  for (const ElementBlock& block : mesh.blocks())
    for (int s = 0; s < num_sides(block.shape); ++s) {
      const std::vector<int> local = side_nodes(block.shape, s);
      for (int e = 0; e < block.num_elements; ++e) {
        const auto found =
            row.find(key(mesh.node_ids()[block.nodes(e, local[0])], mesh.node_ids()[block.nodes(e, local[1])]));
        if (found != row.end()) ++elements[found->second];
      }
    }
  elements = reduced(mesh, Teuchos::REDUCE_SUM, elements);
  for (std::size_t k = 0; k < elements.size(); ++k)
    if (elements[k] > 1)
      section.fail("side set '" + name + "' has a side between two elements, at " +
                       place_text({sides.middles[2 * k], sides.middles[2 * k + 1]}) +
                       "; all its sides must be on the boundary of the mesh",
                   entry);
}

std::array<double, 2> middle_of(const GlobalMesh& mesh, const ElementSide& side) {
  if (side.nodes.size() > 2) return mesh.coordinates[side.nodes[2]];
  const auto &a = mesh.coordinates[side.nodes[0]], &b = mesh.coordinates[side.nodes[1]];
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
}

std::string place_text(const std::array<double, 2>& point) {
  char text[80];
  std::snprintf(text, sizeof text, "(%.6g, %.6g)", point[0], point[1]);
  return text;
}

}  // namespace mudline
