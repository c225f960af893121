#include "ale/simplex_mesh.hpp"

#include <algorithm>
#include <cstdint>

#include "discretisation/space_filling_curve.hpp"
#include "tensor/vec.hpp"

namespace mudline {

SimplexMesh::SimplexMesh(const std::vector<ElementBlock>& blocks) : cells_(blocks.size()) {
  for (const ElementBlock& block : blocks) blocks_.push_back({block.region, block.shape, {}});
}

void SimplexMesh::sort() {
  Bounds box = Bounds::nothing();
  for (const Point& place : places) box.enclose(place);
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    const int dim = dimension(blocks_[b].shape);
    std::vector<std::pair<std::uint64_t, Corners>> keyed;
    for (const Corners& cell : cells_[b]) {
      double at[place_size];
      for (int d = 0; d < dim; ++d) {
        double sum = 0;
        for (int c = 0; c <= dim; ++c) sum += places[cell[c]][d];
        at[d] = (sum / (dim + 1) - box.low[d]) / box.extent();
      }
      keyed.emplace_back(along_curve(at, dim), cell);
    }
    std::sort(keyed.begin(), keyed.end());
    for (std::size_t e = 0; e < keyed.size(); ++e) cells_[b][e] = keyed[e].second;
  }
}

long long SimplexMesh::number_of(int vertex, GlobalMesh& mesh) {
  const auto [number, added] = nodes_.emplace(vertex, static_cast<long long>(mesh.coordinates.size()));
  if (added) mesh.coordinates.push_back(places[vertex]);
  return number->second;
}

long long SimplexMesh::number_of_mid_side_node(int a, int b, GlobalMesh& mesh) {
  const Ends ends = ascending(a, b);
  const auto [number, added] = mid_side_nodes_.emplace(ends, static_cast<long long>(mesh.coordinates.size()));
  if (!added) return number->second;
  mesh.coordinates.push_back(middle_place(a, b));
  return number->second;
}

Point SimplexMesh::middle_place(int a, int b) const {
  const Ends ends = ascending(a, b);
  const auto curved = curved_.find(ends);
  return curved != curved_.end() ? curved->second : 0.5 * (places[ends.first] + places[ends.second]);
}

GlobalMesh SimplexMesh::number() {
  sort();
  GlobalMesh mesh;
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    GlobalMesh::Block block = blocks_[b];
    const int edges = order(block.shape) == 2 ? num_edges(block.shape) : 0;
    for (const Corners& cell : cells_[b]) {
      for (int c = 0; c < num_corners(block.shape); ++c) block.nodes.push_back(number_of(cell[c], mesh));
      for (int e = 0; e < edges; ++e) {
        const auto [from, to] = edge_corners(block.shape, e);
        block.nodes.push_back(number_of_mid_side_node(cell[from], cell[to], mesh));
      }
    }
    mesh.blocks.push_back(std::move(block));
  }
  return mesh;
}

std::map<SimplexMesh::Ends, GlobalMesh::Side> SimplexMesh::sides() const {
  std::map<Ends, GlobalMesh::Side> result;
  for (std::size_t b = 0; b < cells_.size(); ++b)
    for (std::size_t e = 0; e < cells_[b].size(); ++e)
      for (int s = 0; s < 3; ++s)
        result[{cells_[b][e][s], cells_[b][e][(s + 1) % 3]}] = {static_cast<int>(b), static_cast<long long>(e), s};
  return result;
}

}  // namespace mudline
