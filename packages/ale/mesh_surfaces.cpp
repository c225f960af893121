#include "ale/mesh_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "tensor/vec.hpp"

namespace mudline {

namespace {

struct SurfaceEdge {
  int a, b, middle;                       // middle -1: straight
  std::vector<std::array<int, 2>> faces;  // (face, its edge)
  bool feature = false, used = false;
};

double angle_between(const Point& a, const Point& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

class SurfaceSplitter {
 public:
  SurfaceSplitter(std::vector<SurfaceFace> faces, const Positions& source, const std::set<int>& corners,
                  double corner_angle, const std::function<bool(int)>& on_body)
      : x_(source), corners_(corners), angle_(corner_angle), on_body_(on_body) {
    faces_ = std::move(faces);
    find_edges();
    for (SurfaceEdge& edge : edges_) edge.feature = divides(edge);
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (edges_[e].feature)
        for (int node : {edges_[e].a, edges_[e].b}) at_[node].push_back(static_cast<int>(e));
  }

  MeshSurfaces split() {
    collect_patches();
    collect_curves();
    return joined_surfaces(std::move(faces_), std::move(curves_), x_.size(), corners_);
  }

 private:
  void find_edges() {
    std::map<std::array<int, 2>, int> numbers;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const SurfaceFace& face = faces_[f];
      const int corners = num_corners(face.shape);
      for (int k = 0; k < corners; ++k) {
        const auto ends = edge_corners(face.shape, k);
        const int a = face.nodes[ends[0]], b = face.nodes[ends[1]];
        const auto [found, made] =
            numbers.emplace(std::array<int, 2>{std::min(a, b), std::max(a, b)}, static_cast<int>(edges_.size()));
        if (made) edges_.push_back({a, b, order(face.shape) == 2 ? face.nodes[corners + k] : -1, {}});
        edges_[found->second].faces.push_back({static_cast<int>(f), k});
      }
    }
  }

  Point normal_at_edge(const std::array<int, 2>& at) const {
    const SurfaceFace& face = faces_[at[0]];
    const auto ends = edge_corners(face.shape, at[1]);
    const auto a = reference_node(face.shape, ends[0]), b = reference_node(face.shape, ends[1]);
    return face_normal(face, {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}, x_);
  }

  bool divides(const SurfaceEdge& edge) const {
    if (edge.faces.size() != 2) return true;
    const SurfaceFace &one = faces_[edge.faces[0][0]], &other = faces_[edge.faces[1][0]];
    if (one.sets != other.sets || one.outer != other.outer) return true;
    if (one.block != other.block || one.other != other.other) return true;
    if (angle_between(normal_at_edge(edge.faces[0]), normal_at_edge(edge.faces[1])) <= angle_) return false;
    return !(on_body_(edge.a) && on_body_(edge.b));
  }

  void collect_patches() {
    std::vector<std::vector<int>> beside(faces_.size());
    for (const SurfaceEdge& edge : edges_)
      if (!edge.feature)
        for (int side = 0; side < 2; ++side) beside[edge.faces[side][0]].push_back(edge.faces[1 - side][0]);
    int patches = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (faces_[f].patch >= 0) continue;
      std::vector<int> open{static_cast<int>(f)};
      faces_[f].patch = patches;
      while (!open.empty()) {
        const int here = open.back();
        open.pop_back();
        for (int next : beside[here]) {
          if (faces_[next].patch >= 0) continue;
          faces_[next].patch = patches;
          open.push_back(next);
        }
      }
      ++patches;
    }
  }

  int other_end(int edge, int node) const { return edges_[edge].a == node ? edges_[edge].b : edges_[edge].a; }

  /// Tangent of the edge at one of its ends, away from that end.
  Point direction(int edge, int node) const {
    const Point chord = x_[other_end(edge, node)] - x_[node];
    if (edges_[edge].middle < 0) return chord;
    return 4 * (x_[edges_[edge].middle] - x_[node]) - chord;
  }

  bool is_end(int node, const std::vector<int>& touching) const {
    if (touching.size() != 2 || corners_.count(node)) return true;
    if (angle_between(direction(touching[0], node), -direction(touching[1], node)) <= angle_) return false;
    return !(on_body_(other_end(touching[0], node)) && on_body_(node) && on_body_(other_end(touching[1], node)));
  }

  void collect_curves() {
    std::set<int> ends;
    for (const auto& [node, touching] : at_)
      if (is_end(node, touching)) ends.insert(node);
    for (const int start : std::set<int>(ends))
      for (int edge : at_.at(start))
        if (!edges_[edge].used) follow(start, edge, ends);
    for (std::size_t e = 0; e < edges_.size(); ++e)  // closed curves without a corner: cut anywhere
      if (edges_[e].feature && !edges_[e].used) {
        ends.insert(edges_[e].a);
        follow(edges_[e].a, static_cast<int>(e), ends);
      }
  }

  void follow(int start, int edge, const std::set<int>& ends) {
    MeshPath path{{start}, edges_[edge].middle >= 0 ? 2 : 1, {}, true};
    for (int node = start;;) {
      SurfaceEdge& here = edges_[edge];
      here.used = true;
      for (const auto& [f, k] : here.faces) {
        const SurfaceFace& face = faces_[f];
        path.outer = path.outer && face.outer;
        path.sets.insert(face.sets.begin(), face.sets.end());
      }
      if (here.middle >= 0) path.nodes.push_back(here.middle);
      node = other_end(edge, node);
      path.nodes.push_back(node);
      if (ends.count(node)) break;
      const std::vector<int>& touching = at_.at(node);
      edge = touching[0] == edge ? touching[1] : touching[0];
    }
    curves_.push_back(std::move(path));
  }

  const Positions& x_;
  const std::set<int>& corners_;
  double angle_;
  const std::function<bool(int)>& on_body_;
  std::vector<SurfaceFace> faces_;
  std::vector<MeshPath> curves_;
  std::vector<SurfaceEdge> edges_;
  std::map<int, std::vector<int>> at_;  // feature edges at a vertex
};

}  // namespace

std::vector<SurfaceFace> boundary_faces(const GhostedMesh& mesh) {
  std::vector<SurfaceFace> faces;
  std::map<std::set<int>, std::set<std::string>> other_sets;  // (nodes) side sets of the side across
  for (const auto& side : mesh.boundary())
    if (side.other >= 0 && side.other < side.block) other_sets[{side.nodes.begin(), side.nodes.end()}] = side.sets;
  for (const auto& side : mesh.boundary()) {
    if (side.other >= 0 && side.other < side.block) continue;
    SurfaceFace face{{side.shape, {}}, side.sets, side.other < 0, side.block, side.other};
    std::copy(side.nodes.begin(), side.nodes.end(), face.nodes.begin());
    const std::set<std::string>& across = other_sets[{side.nodes.begin(), side.nodes.end()}];
    face.sets.insert(across.begin(), across.end());
    faces.push_back(face);
  }
  return faces;
}

MeshSurfaces joined_surfaces(std::vector<SurfaceFace> faces, std::vector<MeshPath> curves, std::size_t nodes,
                             const std::set<int>& corners) {
  MeshSurfaces result{std::move(faces), {}, std::move(curves), std::vector<int>(nodes, -1)};
  for (std::size_t f = 0; f < result.faces.size(); ++f) {
    const SurfaceFace& face = result.faces[f];
    if (face.patch >= static_cast<int>(result.patches.size())) result.patches.resize(face.patch + 1);
    SurfacePatch& patch = result.patches[face.patch];
    patch.faces.push_back(static_cast<int>(f));
    patch.sets = face.sets;
    patch.outer = face.outer;
    for (int a = 0; a < num_nodes(face.shape); ++a) result.patch_of[face.nodes[a]] = face.patch;
  }
  for (const MeshPath& curve : result.curves)
    for (int node : curve.nodes) result.patch_of[node] = -1;
  for (int node : corners) result.patch_of[node] = -1;
  return result;
}

std::vector<char> fixed_nodes(const MeshSurfaces& boundary, std::size_t nodes) {
  std::vector<char> result(nodes, 0);
  for (const SurfaceFace& face : boundary.faces)
    for (int a = 0; a < num_nodes(face.shape); ++a) {
      const int node = face.nodes[a];
      const bool corner = boundary.patch_of[node] < 0;  // also true on curves, corrected below
      result[node] = corner || boundary.patches[face.patch].material;
    }
  for (const MeshPath& path : boundary.curves)
    for (int node : path.nodes) result[node] = 0;
  for (const MeshPath& path : boundary.curves) {
    result[path.nodes.front()] = result[path.nodes.back()] = 1;
    if (path.material)
      for (int node : path.nodes) result[node] = 1;
  }
  return result;
}

MeshSurfaces split_surfaces(std::vector<SurfaceFace> faces, const Positions& source, const std::set<int>& corners,
                            double corner_angle, const std::function<bool(int node)>& on_body) {
  return SurfaceSplitter(std::move(faces), source, corners, corner_angle, on_body).split();
}

}  // namespace mudline
