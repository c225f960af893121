#include "ale/vertex_colours.hpp"

#include <algorithm>
#include <cstdint>

namespace mudline {

namespace {

/// A pseudo-random number of a node, the same on every rank and different for every node (a bijective mixer, Steele et
/// al. 2014).
std::uint64_t priority(long long node) {
  std::uint64_t z = static_cast<std::uint64_t>(node) + 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

}  // namespace

std::vector<std::vector<int>> vertex_colours(const GhostedMesh& mesh, const std::vector<char>& movable) {
  std::vector<std::vector<int>> beside(mesh.num_nodes());
  for (const auto& element : mesh.elements())
    for (int a = 0; a < num_corners(element.shape); ++a)
      for (int b = 0; b < num_corners(element.shape); ++b)
        if (a != b && movable[element.nodes[a]] && movable[element.nodes[b]])
          beside[element.nodes[a]].push_back(element.nodes[b]);
  std::vector<int> waiting;
  for (int node : mesh.owned_nodes())
    if (movable[node]) waiting.push_back(node);
  std::vector<double> colour(mesh.num_nodes(), -1.0);
  while (mesh.any(!waiting.empty())) {
    std::vector<int> later;
    for (int node : waiting) {
      std::vector<char> taken(beside[node].size() + 1, 0);
      bool first = true;  // whether its priority is highest among the uncoloured nodes around
      for (int other : beside[node]) {
        if (colour[other] < 0) first = first && priority(mesh.node_id(node)) > priority(mesh.node_id(other));
        if (colour[other] >= 0 && colour[other] < taken.size()) taken[static_cast<int>(colour[other])] = 1;
      }
      if (!first) {
        later.push_back(node);
        continue;
      }
      const std::size_t free = std::find(taken.begin(), taken.end(), 0) - taken.begin();
      colour[node] = static_cast<double>(free);
    }
    mesh.fill(colour, 1);
    waiting.swap(later);
  }
  const double most = *std::max_element(colour.begin(), colour.end());
  std::vector<std::vector<int>> result(static_cast<std::size_t>(mesh.largest(most) + 1));
  for (int node = 0; node < mesh.num_nodes(); ++node)
    if (colour[node] >= 0 && mesh.is_complete(node)) result[static_cast<std::size_t>(colour[node])].push_back(node);
  return result;
}

}  // namespace mudline
