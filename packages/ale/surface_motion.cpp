#include "ale/surface_motion.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "tensor/mat.hpp"

namespace mudline {

SurfaceMotion::SurfaceMotion(MeshSurfaces surfaces, const Positions& source, double largest_slide,
                             const std::vector<BoundarySimplex>& simplices)
    : surfaces_(std::move(surfaces)), largest_slide_(largest_slide), nodes_(static_cast<int>(source.size())) {
  at_.resize(source.size());
  near_.resize(source.size());
  collect(source);
  tetrahedra_at_.resize(source.size());
  for (const BoundarySimplex& simplex : simplices) add_tetrahedron(simplex, source);
}

void SurfaceMotion::collect(Positions source) {
  patches_.resize(surfaces_.patches.size());
  std::vector<std::vector<int>> touching(nodes_);  // faces by node
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    if (surfaces_.patches[p].material) continue;
    patches_[p].faces = surfaces_.patches[p].faces;
    for (int f : patches_[p].faces) {
      const SurfaceFace& face = surfaces_.faces[f];
      add_corners(face, source);
      for (int a = 0; a < num_nodes(face.shape); ++a) {
        touching[face.nodes[a]].push_back(f);
        const bool first = touching[face.nodes[a]].size() == 1;
        if (first && surfaces_.patch_of[face.nodes[a]] == static_cast<int>(p)) add_node(face, a, patches_[p]);
      }
    }
  }
  for (Patch& patch : patches_) {
    for (int node : patch.vertices) near_[node] = faces_near(node, touching);
    // Centres of faces come after the mid-side nodes of edges, on which they depend.
    std::stable_sort(patch.mid_side_nodes.begin(), patch.mid_side_nodes.end(),
                     [](const MidSideNode& a, const MidSideNode& b) { return a.sides.size() < b.sides.size(); });
    for (MidSideNode& middle : patch.mid_side_nodes) {
      near_[middle.node] = faces_near(middle.node, touching);
      put_on(middle, touching[middle.node]);
      middle.drift = drift_of(middle, source);
    }
  }
  add_curve_mid_side_nodes(touching);
}

void SurfaceMotion::put_on(MidSideNode& middle, const std::vector<int>& faces) const {
  for (int f : faces) {
    const SurfaceFace& face = surfaces_.faces[f];
    const auto here = std::find(face.nodes.begin(), face.nodes.end(), middle.node) - face.nodes.begin();
    const auto xi = reference_node(face.shape, static_cast<int>(here));
    middle.on.push_back({f, {xi[0], xi[1]}});
  }
}

void SurfaceMotion::add_curve_mid_side_nodes(const std::vector<std::vector<int>>& touching) {
  for (const MeshPath& curve : surfaces_.curves)
    if (curve.stride == 2)
      for (std::size_t i = 1; i < curve.nodes.size(); i += 2) {
        MidSideNode middle{curve.nodes[i], {curve.nodes[i - 1], curve.nodes[i + 1]}, {}};
        put_on(middle, touching[middle.node]);
        curve_mid_side_nodes_.push_back(std::move(middle));
      }
}

void SurfaceMotion::add_node(const SurfaceFace& face, int a, Patch& patch) {
  const int corners = num_corners(face.shape);
  if (a < corners) {
    patch.vertices.push_back(face.nodes[a]);
    return;
  }
  MidSideNode middle{face.nodes[a], {}, {}};
  for (int c : corners_around(face.shape, a)) middle.ends.push_back(face.nodes[c]);
  if (a == 2 * corners)
    for (int k = 0; k < corners; ++k) middle.sides.push_back(face.nodes[corners + k]);
  patch.mid_side_nodes.push_back(middle);
}

std::vector<int> SurfaceMotion::faces_near(int node, const std::vector<std::vector<int>>& touching) const {
  std::set<int> near;
  for (int f : touching[node]) {
    const SurfaceFace& face = surfaces_.faces[f];
    for (int a = 0; a < num_corners(face.shape); ++a)
      for (int other : touching[face.nodes[a]])
        if (surfaces_.faces[other].patch == face.patch) near.insert(other);
  }
  return {near.begin(), near.end()};
}

void SurfaceMotion::add_corners(const SurfaceFace& face, Positions& source) {
  const int corners = num_corners(face.shape);
  const auto corner = [&](int i) { return face.nodes[(i + corners) % corners]; };
  for (int i = 0; i < (corners == 3 ? 1 : 4); ++i) add_corner({corner(i), corner(i + 1), corner(i - 1)}, source);
  if (order(face.shape) == 2)
    for (int i = 0; i < corners; ++i) {
      const int a = corner(i), b = corner(i + 1), middle = face.nodes[corners + i];
      if (surfaces_.patch_of[middle] >= 0) continue;
      const int end = static_cast<int>(source.size());
      for (const Tangent& tangent : {Tangent{a, b, middle}, Tangent{b, a, middle}}) {
        tangents_.push_back(tangent);
        source.push_back(tangent_end(tangent, source));
      }
      add_corner({a, end, corner(i - 1)}, source);
      add_corner({end + 1, b, corner(i + 2)}, source);
    }
}

Point SurfaceMotion::tangent_end(const Tangent& tangent, const Positions& x) {
  // derivative of the quadratic edge at its end, over a reference length of 1
  return 4 * x[tangent.middle] - 2 * x[tangent.at] - x[tangent.other];
}

std::array<Point, 4> SurfaceMotion::corners_of(const BoundarySimplex& simplex, const Positions& x) {
  std::array<Point, 4> result;
  for (int k = 0; k < 4; ++k) {
    const int node = simplex.nodes[k], middle = simplex.mid_side_nodes[k];
    result[k] = middle < 0 ? x[node] : tangent_end({simplex.nodes[0], node, middle}, x);
  }
  return result;
}

void SurfaceMotion::add_tetrahedron(const BoundarySimplex& simplex, const Positions& source) {
  const auto slides = [&](int node) {
    const int patch = surfaces_.patch_of[node];
    return patch >= 0 && !surfaces_.patches[patch].material;
  };
  if (std::none_of(simplex.nodes.begin(), simplex.nodes.end(), slides)) return;
  for (int node : simplex.nodes) tetrahedra_at_[node].push_back(static_cast<int>(tetrahedra_.size()));
  tetrahedra_.push_back({simplex, IdealSimplex<3>(corners_of(simplex, source))});
}

void SurfaceMotion::add_tangents(Positions& x) const {
  x.resize(nodes_ + tangents_.size());
  for (std::size_t i = 0; i < tangents_.size(); ++i) x[nodes_ + i] = tangent_end(tangents_[i], x);
}

void SurfaceMotion::add_corner(const std::array<int, 3>& nodes, const Positions& source) {
  const Point p = source[nodes[1]] - source[nodes[0]], q = source[nodes[2]] - source[nodes[0]];
  const Point e = unit(p);
  const double a = length(p), b = dot(q, e), c = length(q - b * e), scale = std::sqrt(a * c);  // size does not count
  const Mat<double, 2> inverse = {{{scale / a, -b * scale / (a * c)}, {0, scale / c}}};
  Corner corner{nodes, {}};
  for (int k = 0; k < 2; ++k) {
    corner.w[1][k] = inverse[0][k];
    corner.w[2][k] = inverse[1][k];
    corner.w[0][k] = -inverse[0][k] - inverse[1][k];
  }
  for (int node : nodes)
    if (node < nodes_) at_[node].push_back(static_cast<int>(corners_.size()));
  corners_.push_back(corner);
}

double SurfaceMotion::edge_of(const MidSideNode& middle, const Positions& x) {
  return length(x[middle.ends[1]] - x[middle.ends[0]]);
}

Point SurfaceMotion::middle_of(const MidSideNode& middle, const Positions& x) {
  Point sum{};
  if (middle.sides.empty()) {
    for (int node : middle.ends) sum += 0.5 * x[node];
    return sum;
  }
  for (int node : middle.sides) sum += 0.5 * x[node];  // transfinite: exact for straight edges
  for (int node : middle.ends) sum -= 0.25 * x[node];
  return sum;
}

Point SurfaceMotion::normal_at(const MidSideNode& middle, const Positions& x) const {
  Point sum{};
  for (const auto& [face, place] : middle.on) sum += unit(face_normal(surfaces_.faces[face], place, x));
  return unit(sum);
}

double SurfaceMotion::drift_of(const MidSideNode& middle, const Positions& x) const {
  const Point off = x[middle.node] - middle_of(middle, x), normal = normal_at(middle, x);
  return length(off - dot(off, normal) * normal) / edge_of(middle, x);
}

Point SurfaceMotion::at(const SurfacePlace& place, const Positions& x) const {
  return face_point(surfaces_.faces[place.face], place.xi, x);
}

SurfacePlace SurfaceMotion::nearest(int node, int guess, const Positions& x_old, const Point& point) const {
  if (guess >= 0) {
    const ClosestOnSide there = closest_on_side(surfaces_.faces[guess], x_old, point);
    if (there.inside) return {guess, there.place};
  }
  SurfacePlace best;
  double least = 1e300;
  for (int f : near_[node]) {
    const SurfaceFace& face = surfaces_.faces[f];
    Bounds box = Bounds::nothing();
    for (int a = 0; a < num_nodes(face.shape); ++a) box.enclose(x_old[face.nodes[a]]);
    const Point across = 0.5 * (box.high - box.low);
    // a curved face is not far outside the box of its nodes
    if (length(point - (box.low + across)) - 1.5 * length(across) > least) continue;
    const ClosestOnSide there = closest_on_side(face, x_old, point, least);
    if (there.distance >= least) continue;
    least = there.distance;
    best = {f, there.place};
  }
  return best;
}

SurfacePlace SurfaceMotion::place(int node, const Positions& x_old, const Point& x) const {
  return nearest(node, -1, x_old, x);
}

std::vector<std::pair<int, double>> SurfaceMotion::outer_nodes(const Positions& x) const {
  std::vector<std::pair<int, double>> result;
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    if (!surfaces_.patches[p].outer) continue;
    for (int node : patches_[p].vertices) result.emplace_back(node, shortest_edge(node, x));
    for (const MidSideNode& middle : patches_[p].mid_side_nodes) result.emplace_back(middle.node, edge_of(middle, x));
  }
  return result;
}

std::vector<int> SurfaceMotion::nodes() const {
  std::vector<int> result;
  for (const Patch& patch : patches_) {
    result.insert(result.end(), patch.vertices.begin(), patch.vertices.end());
    for (const MidSideNode& middle : patch.mid_side_nodes) result.push_back(middle.node);
  }
  return result;
}

double SurfaceMotion::shortest_edge(int node, const Positions& x) const {
  double shortest = 1e300;
  for (int c : at_[node])
    for (int other : corners_[c].nodes)
      if (other != node && other < nodes_) shortest = std::min(shortest, length(x[other] - x[node]));
  return shortest;
}

}  // namespace mudline
