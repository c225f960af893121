#include "ale/mesh_paths.hpp"

#include <algorithm>
#include <cmath>

namespace mudline {

namespace {

struct PathSide {
  int from, to, middle;  // middle -1: straight
  std::set<std::string> sets;
  bool outer;
  bool used = false;
};

/// Sides on the outer boundary and between regions; an outer side keeps the direction of its element.
std::vector<PathSide> feature_edges(const GhostedMesh& mesh) {
  std::vector<PathSide> edges;
  for (const auto& side : mesh.boundary())
    if (side.first)
      edges.push_back(
          {side.nodes[0], side.nodes[1], side.nodes.size() > 2 ? side.nodes[2] : -1, side.sets, side.other < 0});
  return edges;
}

double turning(const Positions& x, int before, int at, int after) {
  const double ax = x[at][0] - x[before][0], ay = x[at][1] - x[before][1];
  const double bx = x[after][0] - x[at][0], by = x[after][1] - x[at][1];
  return std::abs(std::atan2(ax * by - ay * bx, ax * bx + ay * by));
}

class Splitter {
 public:
  Splitter(const GhostedMesh& mesh, const Positions& source, const std::set<int>& corners, double corner_angle,
           const std::function<bool(int)>& on_body)
      : x_(source), edges_(feature_edges(mesh)), on_body_(on_body) {
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      at_[edges_[i].from].push_back(static_cast<int>(i));
      at_[edges_[i].to].push_back(static_cast<int>(i));
    }
    for (const auto& [node, touching] : at_)
      if (touching.size() != 2 || corners.count(node) || edges_[touching[0]].sets != edges_[touching[1]].sets ||
          is_corner(other_end(touching[0], node), node, other_end(touching[1], node), corner_angle))
        ends_.insert(node);
  }

  std::vector<MeshPath> paths() {
    std::vector<MeshPath> result;
    for (int start : ends_)
      for (int edge : at_.at(start))
        if (!edges_[edge].used) result.push_back(follow(start, edge));
    for (std::size_t i = 0; i < edges_.size(); ++i)  // closed curves without a corner: cut anywhere
      if (!edges_[i].used) {
        ends_.insert(edges_[i].from);
        result.push_back(follow(edges_[i].from, static_cast<int>(i)));
      }
    return result;
  }

 private:
  bool is_corner(int before, int at, int after, double corner_angle) const {
    if (turning(x_, before, at, after) <= corner_angle) return false;
    return !(on_body_(before) && on_body_(at) && on_body_(after));
  }
  int other_end(int edge, int node) const { return edges_[edge].from == node ? edges_[edge].to : edges_[edge].from; }

  MeshPath follow(int start, int edge) {
    MeshPath path{{start}, edges_[edge].middle >= 0 ? 2 : 1, edges_[edge].sets, edges_[edge].outer};
    for (int node = start;;) {
      PathSide& here = edges_[edge];
      here.used = true;
      if (here.middle >= 0) path.nodes.push_back(here.middle);
      const int next = other_end(edge, node);
      path.nodes.push_back(node = next);
      if (ends_.count(node)) break;
      const std::vector<int>& touching = at_.at(node);
      edge = touching[0] == edge ? touching[1] : touching[0];
    }
    return path;
  }

  const Positions& x_;
  std::vector<PathSide> edges_;
  std::map<int, std::vector<int>> at_;
  std::set<int> ends_;
  const std::function<bool(int)>& on_body_;
};

}  // namespace

CurvedSide MeshPath::side(int first) const {
  const int last = first + stride;
  if (stride == 1) return {CellShape::line2, {nodes[first], nodes[last]}};
  return {CellShape::line3, {nodes[first], nodes[last], nodes[first + 1]}};
}

std::vector<MeshPath> find_paths(const GhostedMesh& mesh, const Positions& source, const std::set<int>& corners,
                                 double corner_angle, const std::function<bool(int node)>& on_body) {
  return Splitter(mesh, source, corners, corner_angle, on_body).paths();
}

}  // namespace mudline
