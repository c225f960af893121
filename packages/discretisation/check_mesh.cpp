#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "core/errors.hpp"
#include "core/text.hpp"
#include "core/told.hpp"
#include "discretisation/distribute.hpp"
#include "discretisation/mesh_topology.hpp"
#include "discretisation/side_table.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

std::string centre(const GlobalMesh& mesh, const long long* nodes, CellShape shape) {
  const ElementMap map(linear_partner(shape), [&](int c) { return mesh.coordinates[nodes[c]]; });
  return place_text(map.mean_of_corners(), dimension(shape));
}

/// Calls f(block, nodes of the element).
template <class F>
void for_each_element(const GlobalMesh& mesh, F&& f) {
  for (const auto& block : mesh.blocks)
    for (std::size_t first = 0; first < block.nodes.size(); first += num_nodes(block.shape))
      f(block, block.nodes.data() + first);
}

void check_dimension(const GlobalMesh& mesh, Geometry geometry) {
  const int expected = dimension(geometry);
  for (const auto& block : mesh.blocks) {
    if (dimension(block.shape) == expected) continue;
    throw InputError("region '" + block.region + "' has " + name(block.shape) + " cells, which are " +
                     (expected == 2 ? "of space; they need the geometry 'three-dimensional'"
                                    : "of the plane; the geometry 'three-dimensional' needs tetrahedra or hexahedra"));
  }
}

/// Names of regions and sets go into results and reports.
void check_names(const GlobalMesh& mesh) {
  const auto check = [](const std::string& name) {
    if (const std::string bad = unfit(name); !bad.empty())
      throw InputError("the mesh has a name '" + beginning(name, 200) + "', which holds " + bad);
  };
  for (const auto& block : mesh.blocks) check(block.region);
  for (const auto& [name, sides] : mesh.side_sets) check(name);
  for (const auto& [name, nodes] : mesh.node_sets) check(name);
}

void check_blocks(const GlobalMesh& mesh) {
  const GlobalMesh::Block* previous = nullptr;
  for (const auto& block : mesh.blocks) {
    if (block.nodes.size() % num_nodes(block.shape) != 0) throw std::logic_error("a mesh block has half an element");
    for (long long node : block.nodes)
      if (node < 0 || node >= static_cast<long long>(mesh.coordinates.size()))
        throw std::logic_error("a mesh block names a node that does not exist");
    if (previous != nullptr && order(block.shape) != order(previous->shape))
      throw InputError("the mesh mixes linear and quadratic elements: " + std::string(name(previous->shape)) +
                       " in region '" + previous->region + "', " + name(block.shape) + " in '" + block.region + "'");
    previous = &block;
  }
  if (std::all_of(mesh.blocks.begin(), mesh.blocks.end(), [](const auto& block) { return block.nodes.empty(); }))
    throw InputError("the mesh has no elements");
}

void check_nodes(const GlobalMesh& mesh, Geometry geometry) {
  std::vector<char> used(mesh.coordinates.size(), 0);
  for (const auto& block : mesh.blocks)
    for (long long node : block.nodes) used[node] = 1;
  const auto orphans = std::count(used.begin(), used.end(), 0);
  if (orphans > 0) {
    const auto first = std::find(used.begin(), used.end(), 0) - used.begin();
    throw InputError(std::to_string(orphans) + " nodes of the mesh belong to no element; the first is at " +
                     place_text(mesh.coordinates[first], mesh.dimension()));
  }
  if (geometry != Geometry::axisymmetric) return;
  double largest = 0;
  for (const auto& point : mesh.coordinates) largest = std::max(largest, std::abs(point[0]));
  for (const auto& point : mesh.coordinates)
    if (point[0] < -1e-12 * largest)
      throw InputError("an axisymmetric mesh needs radii x >= 0, but has a node at " + place_text(point, 2));
}

/// Neighbours see their common side with opposite orientation and share its mid-side node; an orientation that is met
/// twice means that elements overlap.
void check_sides(const GlobalMesh& mesh) {
  struct Seen {
    SideKey orientation;
    CellShape shape;
    long long centre;   // -1: its shape has none
    bool both = false;  // seen from both elements
  };
  std::vector<Seen> sides;  // by number
  SideTable table(count_over_elements(mesh, num_sides) / 2 + 1);
  for_each_side(mesh, [&](const GlobalMesh::Side& place, const std::vector<long long>& nodes) {
    const GlobalMesh::Block& block = mesh.blocks[place.block];
    const CellShape shape = side_shape(block.shape, place.side);
    const int corners = num_corners(shape);
    const SideKey orientation = directed_key(nodes.data(), corners);
    const bool has_centre = shape == CellShape::quad9 || shape == CellShape::line3;
    const long long centre_node = has_centre ? nodes.back() : -1;
    const std::size_t number = table.number(sorted_key(nodes.data(), corners));
    if (number == sides.size()) return sides.push_back({orientation, shape, centre_node});
    Seen& seen = sides[number];
    const auto where = [&] {
      return " in region '" + block.region + "' centred at " +
             centre(mesh, block.nodes.data() + place.element * num_nodes(block.shape), block.shape);
    };
    const auto corner = [&](long long node) { return place_text(mesh.coordinates[node], mesh.dimension()); };
    if (seen.both || seen.orientation == orientation)
      throw InputError("elements overlap: two of them have the same side, one is" + where());
    if (seen.orientation != reversed_key(orientation))
      throw InputError("neighbours do not fit: the corners of their common side go round in different orders, one is" +
                       where());
    if (seen.shape != shape)
      throw InputError("neighbours do not fit: their common side has " + std::to_string(num_nodes(seen.shape)) +
                       " nodes in one and " + std::to_string(num_nodes(shape)) + " in the other, which is" + where());
    if (seen.centre != centre_node)
      throw InputError("neighbours do not share the node in the middle of their common " +
                       (corners == 2 ? "side from " + corner(std::min(nodes[0], nodes[1])) + " to " +
                                           corner(std::max(nodes[0], nodes[1]))
                                     : "face at " + place_text(mesh.coordinates[nodes.back()], 3)));
    seen.both = true;
  });
}

/// Cells of space share the mid-side nodes of common edges. (In the plane the edges are the sides.)
void check_edges(const GlobalMesh& mesh) {
  if (mesh.dimension() == 2) return;
  std::vector<long long> mid_side_nodes;  // by number
  SideTable table(count_over_elements(mesh, num_edges) / 4 + 1);
  for_each_element(mesh, [&](const GlobalMesh::Block& block, const long long* nodes) {
    if (order(block.shape) == 1) return;
    for (int edge = 0; edge < num_edges(block.shape); ++edge) {
      const std::array<int, 2>& ends = edge_corners(block.shape, edge);
      const long long corners[2] = {nodes[ends[0]], nodes[ends[1]]},
                      mid_side_node = nodes[num_corners(block.shape) + edge];
      const std::size_t number = table.number(sorted_key(corners, 2));
      if (number == mid_side_nodes.size()) mid_side_nodes.push_back(mid_side_node);
      if (mid_side_nodes[number] == mid_side_node) continue;
      throw InputError("neighbours do not share the node in the middle of their common edge from " +
                       place_text(mesh.coordinates[corners[0]], 3) + " to " +
                       place_text(mesh.coordinates[corners[1]], 3));
    }
  });
}

/// The points at which the Jacobian is checked: the usual quadrature points, and the corners, where a curved side folds
/// an element first.
std::vector<Vec<double, 3>> jacobian_points(CellShape shape) {
  std::vector<Vec<double, 3>> points = cell_quadrature(shape, 4).points;
  for (int c = 0; c < num_corners(shape); ++c) points.push_back(reference_node(shape, c));
  return points;
}

void check_jacobians(const GlobalMesh& mesh) {
  const GlobalMesh::Block* current = nullptr;
  std::vector<Vec<double, 3>> points;
  for_each_element(mesh, [&](const GlobalMesh::Block& block, const long long* nodes) {
    if (&block != current) points = jacobian_points(block.shape);
    current = &block;
    double lowest = std::numeric_limits<double>::max(), size = 0, round_off = 1e-10;
    const ElementMap map(block.shape, [&](int a) { return mesh.coordinates[nodes[a]]; });
    for (const auto& point : points) {
      const double value = map.determinant(point.data());
      if (!std::isfinite(value)) throw InputError("the mesh has a coordinate that is not finite");
      lowest = std::min(lowest, value);
    }
    for (int c = 0; c < num_corners(block.shape); ++c)
      for (int d = 0; d < dimension(block.shape); ++d)
        size = std::max(size, std::abs(mesh.coordinates[nodes[c]][d] - mesh.coordinates[nodes[0]][d]));
    for (int d = 0; d < dimension(block.shape); ++d) round_off *= size;  // a sliver is refused like a flat element
    if (lowest > round_off) return;
    throw InputError("element with " + std::string(lowest < -round_off ? "negative" : "zero") +
                     " Jacobian in region '" + block.region + "' centred at " + centre(mesh, nodes, block.shape) +
                     ": it is inverted, flat, or its sides are too curved");
  });
}

void check_sets(const GlobalMesh& mesh) {
  for (const auto& [name, sides] : mesh.side_sets) {
    if (sides.empty()) throw InputError("the side set '" + name + "' is empty");
    if (mesh.node_sets.count(name) != 0)
      throw InputError("the name '" + name + "' belongs to a set of sides and to a set of points");
    std::set<std::array<long long, 3>> seen;
    for (const auto& side : sides)
      if (!seen.insert({side.block, side.element, side.side}).second)
        throw InputError("a side occurs twice in the side set '" + name + "'");
  }
  for (const auto& [name, nodes] : mesh.node_sets)
    if (nodes.empty()) throw InputError("the set of points '" + name + "' is empty");
}

}  // namespace

void check_mesh(const GlobalMesh& mesh, Geometry geometry) {
  check_names(mesh);
  check_blocks(mesh);
  check_dimension(mesh, geometry);
  check_nodes(mesh, geometry);
  check_jacobians(mesh);
  check_sides(mesh);
  check_edges(mesh);
  check_sets(mesh);
}

}  // namespace mudline
