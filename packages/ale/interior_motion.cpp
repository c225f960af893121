#include "ale/interior_motion.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace mudline {

CornerTriangles::CornerTriangles(const GhostedMesh& mesh, const std::vector<MeshPath>& paths)
    : at_node(mesh.num_nodes()), nodes_(mesh.num_nodes()) {
  std::set<int> curved;  // middle nodes on paths
  for (const MeshPath& path : paths)
    for (std::size_t i = 1; path.stride == 2 && i < path.nodes.size(); i += 2) curved.insert(path.nodes[i]);
  for (const auto& element : mesh.elements()) {
    const auto& n = element.nodes;
    if (num_corners(element.shape) == 3)
      triangles.push_back({n[0], n[1], n[2]});
    else
      for (int i = 0; i < 4; ++i) triangles.push_back({n[i], n[(i + 1) % 4], n[(i + 3) % 4]});
  }
  of_elements = static_cast<int>(triangles.size());
  for (const auto& element : mesh.elements()) {
    if (order(element.shape) == 1) continue;
    const int corners = num_corners(element.shape);
    for (int s = 0; s < corners; ++s) {
      const int a = element.nodes[s], b = element.nodes[(s + 1) % corners], middle = element.nodes[corners + s];
      if (!curved.count(middle)) continue;
      const int first = nodes_ + static_cast<int>(tangents_.size());
      tangents_.push_back({a, b, middle});
      tangents_.push_back({b, a, middle});
      triangles.push_back({a, first, element.nodes[(s + corners - 1) % corners]});
      triangles.push_back({first + 1, b, element.nodes[(s + 2) % corners]});
    }
  }
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int node : triangles[t])
      if (node < nodes_) at_node[node].push_back(static_cast<int>(t));
}

void CornerTriangles::add_tangents(const Positions& curve, Positions& x) const {
  x.resize(nodes_ + tangents_.size());
  for (std::size_t i = 0; i < tangents_.size(); ++i)
    for (int d = 0; d < place_size; ++d)  // derivative of the quadratic side at its end, over a reference length of 1
      x[nodes_ + i][d] =
          4 * curve[tangents_[i].middle][d] - 2 * curve[tangents_[i].at][d] - curve[tangents_[i].other][d];
}

double twice_area(const std::array<int, 3>& t, const Positions& x) {
  return (x[t[1]][0] - x[t[0]][0]) * (x[t[2]][1] - x[t[0]][1]) - (x[t[1]][1] - x[t[0]][1]) * (x[t[2]][0] - x[t[0]][0]);
}

void SweepLimits::parameters(Parameters& p) {
  p.add("sweeps", sweeps, "-", closed(1, 100000), "largest number of passes over the vertices");
  p.add("sweep tolerance", tolerance, "-", positive(),
        "passes end when no vertex moves by more than this share of its elements' size");
}

void LaplaceMotion::move(const InteriorMesh& mesh, Positions& x) const {
  const auto& triangles = mesh.corners.triangles;
  std::vector<std::vector<int>> neighbours(mesh.movable.size());
  for (const auto& nodes : mesh.colours)
    for (int node : nodes) {
      std::set<int> around;
      for (int t : mesh.corners.at_node[node])
        if (t < mesh.corners.of_elements) around.insert(triangles[t].begin(), triangles[t].end());
      around.erase(node);
      neighbours[node].assign(around.begin(), around.end());
    }
  sweep_by_colours(mesh, limits_, x, [&](int node) {
    std::array<double, 2> mean{};
    double size = 0;
    for (int other : neighbours[node])
      for (int d = 0; d < place_size; ++d) mean[d] += x[other][d] / neighbours[node].size();
    for (int other : neighbours[node]) size = std::max(size, std::hypot(x[other][0] - mean[0], x[other][1] - mean[1]));
    const double way = std::hypot(mean[0] - x[node][0], mean[1] - x[node][1]) / size;
    x[node] = mean;
    return way;
  });
}

void sweep_by_colours(const InteriorMesh& mesh, const SweepLimits& limits, Positions& x,
                      const std::function<double(int node)>& place) {
  const int colours = static_cast<int>(mesh.colours.size());
  for (int sweep = 0; sweep < limits.sweeps; ++sweep) {
    double largest = 0;
    for (int k = 0; k < colours; ++k) {
      for (int node : mesh.colours[sweep % 2 == 0 ? k : colours - 1 - k]) largest = std::max(largest, place(node));
      mesh.mesh.fill(x);
    }
    if (mesh.mesh.largest(largest) < limits.tolerance) break;
  }
}

void register_interior_motions(Registry<InteriorMotion>& registry) {
  registry.add<OptimisationMotion>("optimisation", "best element shapes, never folds an element");
  registry.add<WinslowMotion>("Winslow", "harmonic map back to the source's mesh, never folds an element");
  registry.add<ElasticMotion>("elastic", "elastic re-analysis with the boundary's displacements");
  registry.add<ArtificialMotion>("artificial",
                                 "elastic, and a swing of every vertex: shows what the remap does to a solution");
  registry.add<LaplaceMotion>("Laplace", "every vertex at the mean of its neighbours");
}

}  // namespace mudline
