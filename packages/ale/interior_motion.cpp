#include "ale/interior_motion.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "algebra/raw_communicator.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

using Corners = std::vector<std::array<int, 4>>;  // local numbers; in the plane three

/// (corner) the corner and the other ends of its edges, ordered such that the determinant is positive in a sound cell.
Corners find_corners(CellShape shape) {
  const int dim = dimension(shape);
  Corners result;
  for (int c = 0; c < num_corners(shape); ++c) {
    Simplex here{{c}, dim + 1};
    Positions x;
    for (int e = 0, k = 1; e < num_edges(shape); ++e) {
      const auto [a, b] = edge_corners(shape, e);
      if (a == c || b == c) here.corner[k++] = a == c ? b : a;
    }
    for (int a = 0; a < num_corners(shape); ++a) x.push_back(reference_node(shape, a));
    if (determinant(here, x) < 0) std::swap(here.corner[dim - 1], here.corner[dim]);
    result.push_back(here.corner);
  }
  return result;
}

const Corners& corners_of(CellShape shape) {
  static const std::map<CellShape, Corners> all = [] {
    std::map<CellShape, Corners> found;
    for (int s = 0; s < num_shapes; ++s) {
      const auto shape = static_cast<CellShape>(s);
      if (order(shape) == 1 && dimension(shape) > 1) found[shape] = find_corners(shape);
    }
    return found;
  }();
  return all.at(linear_partner(shape));
}

}  // namespace

CornerSimplices::CornerSimplices(const GhostedMesh& mesh) : at_node(mesh.num_nodes()), nodes_(mesh.num_nodes()) {
  const Corners itself{{0, 1, 2, 3}};
  for (const auto& element : mesh.elements())
    for (const auto& local : is_simplex(element.shape) ? itself : corners_of(element.shape)) {
      Simplex simplex{{}, mesh.dimension() + 1};
      for (int k = 0; k <= mesh.dimension(); ++k) simplex.corner[k] = element.nodes[local[k]];
      simplices.push_back(simplex);
    }
  of_elements = static_cast<int>(simplices.size());
  for (const auto& element : mesh.elements()) {
    if (order(element.shape) == 1) continue;
    mesh.dimension() == 2 ? add_curved_sides(mesh, element) : add_curved_corners(mesh, element);
  }
  for (std::size_t t = 0; t < simplices.size(); ++t)
    for (int node : simplices[t])
      if (node < nodes_) at_node[node].push_back(static_cast<int>(t));
}

int CornerSimplices::tangent(int at, int other, int middle) {
  tangents_.push_back({at, other, middle});
  return nodes_ + static_cast<int>(tangents_.size()) - 1;
}

/// Adds, in the plane, two triangles for each curved side, with the element's straight sides beside it.
void CornerSimplices::add_curved_sides(const GhostedMesh& mesh, const GhostedMesh::Element& element) {
  const int corners = num_corners(element.shape);
  for (int s = 0; s < corners; ++s) {
    const int a = element.nodes[s], b = element.nodes[(s + 1) % corners], middle = element.nodes[corners + s];
    if (!mesh.on_boundary(middle)) continue;
    const int first = tangent(a, b, middle), second = tangent(b, a, middle);
    simplices.push_back({{a, first, element.nodes[(s + corners - 1) % corners]}, 3});
    simplices.push_back({{second, b, element.nodes[(s + 2) % corners]}, 3});
  }
}

/// Adds, in space, a tetrahedron for each corner where edges are curved, with the tangents of all of these.
void CornerSimplices::add_curved_corners(const GhostedMesh& mesh, const GhostedMesh::Element& element) {
  const int corners = num_corners(element.shape);
  for (const auto& local : corners_of(element.shape)) {
    Simplex simplex{{}, 4};
    bool curved = false;
    for (int k = 0; k < 4; ++k) simplex.corner[k] = element.nodes[local[k]];
    for (int e = 0; e < num_edges(element.shape); ++e) {
      const auto [a, b] = edge_corners(element.shape, e);
      const int middle = element.nodes[corners + e];
      if ((a != local[0] && b != local[0]) || !mesh.on_boundary(middle)) continue;
      const int other = a == local[0] ? b : a;
      for (int k = 1; k < 4; ++k)
        if (local[k] == other) simplex.corner[k] = tangent(element.nodes[local[0]], element.nodes[other], middle);
      curved = true;
    }
    if (curved) simplices.push_back(simplex);
  }
}

std::vector<BoundarySimplex> CornerSimplices::on_boundary(const GhostedMesh& mesh) const {
  constexpr int size = 8;
  using Record = std::array<long long, size>;
  std::vector<long long> mine;
  for (const Simplex& simplex : simplices) {
    Record record;
    bool inside = false;
    for (int k = 0; k < 4; ++k) {
      const int place = simplex[k] - nodes_, node = place < 0 ? simplex[k] : tangents_[place].other;
      record[k] = mesh.node_id(node);
      record[4 + k] = place < 0 ? -1 : mesh.node_id(tangents_[place].middle);
      inside = inside || !mesh.on_boundary(node);
    }
    if (!inside) mine.insert(mine.end(), record.begin(), record.end());
  }
  const std::vector<long long> all = all_gather(*mesh.mesh().comm(), mine);
  std::set<Record> records;  // a set, because ghosts come more than once
  for (std::size_t i = 0; i < all.size(); i += size) {
    Record record;
    std::copy_n(&all[i], size, record.begin());
    records.insert(record);
  }
  std::vector<BoundarySimplex> result;
  for (const Record& record : records) {
    BoundarySimplex simplex;
    for (int k = 0; k < 4; ++k) {
      simplex.nodes[k] = mesh.local_node(record[k]);
      simplex.mid_side_nodes[k] = record[4 + k] < 0 ? -1 : mesh.local_node(record[4 + k]);
    }
    result.push_back(simplex);
  }
  return result;
}

void CornerSimplices::add_tangents(const Positions& curve, Positions& x) const {
  x.resize(nodes_ + tangents_.size());
  for (std::size_t i = 0; i < tangents_.size(); ++i)
    for (int d = 0; d < place_size; ++d)  // derivative of the quadratic edge at its end, over a reference length of 1
      x[nodes_ + i][d] =
          4 * curve[tangents_[i].middle][d] - 2 * curve[tangents_[i].at][d] - curve[tangents_[i].other][d];
}

double determinant(const Simplex& t, const Positions& x) {
  const Point &a = x[t[0]], &b = x[t[1]], &c = x[t[2]];
  if (t.corners == 3) return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  return dot(b - a, cross(c - a, x[t[3]] - a));
}

double size(const Simplex& t, const Positions& x) {
  const double content = std::abs(determinant(t, x));
  return t.corners == 3 ? std::sqrt(content) : std::cbrt(content);
}

void register_interior_motions(Registry<InteriorMotion>& registry) {
  registry.add<OptimisationMotion>("optimisation", "best element shapes, never folds an element");
  registry.add<ElasticMotion>("elastic", "elastic re-analysis with the boundary's displacements");
}

}  // namespace mudline
