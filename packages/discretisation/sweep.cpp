#include "discretisation/sweep.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "core/errors.hpp"
#include "core/text.hpp"
#include "core/told.hpp"
#include "discretisation/distribute.hpp"
#include "discretisation/mesh_topology.hpp"

namespace mudline {

namespace {

/// Shape of the cells that an element which stays clear of the axis becomes. `complete`: the mesh has sides of 9 nodes.
CellShape swept_shape(CellShape plane, bool wedges, bool complete) {
  const bool linear = order(plane) == 1;
  if (!is_simplex(plane)) return linear ? CellShape::hex8 : CellShape::hex27;
  if (!wedges) return linear ? CellShape::tet4 : CellShape::tet10;
  if (linear) return CellShape::wedge6;
  return complete ? CellShape::wedge18 : CellShape::wedge15;
}

/// A corner of a cell of one layer: a corner of the plane's element, at the layer's start (0) or end (1).
struct Corner {
  int node;
  int end;
};

/// Sweeps one mesh.
class Sweeper {
 public:
  Sweeper(const GlobalMesh& plane, const Sweep& sweep);
  GlobalMesh mesh();

 private:
  /// A plane element that is swept through a layer.
  struct Element {
    int block;
    long long number;  // in its block
    CellShape shape;
    const long long* nodes;
    int layer;
  };

  int count_fixed(const Element& element) const;
  [[noreturn]] void refuse(const Element& element, const std::string& what, const std::string& remedy) const;
  void sweep_triangle(const Element& element);
  void sweep_quadrilateral(const Element& element);
  std::vector<std::vector<Corner>> cut_prism(const Element& element) const;
  /// The corners of an element at the start of the layer, then those at its end, or the other way round, so that the
  /// cell is not folded.
  std::vector<Corner> drawn(const Element& element) const;
  /// The block of an element's region with cells of this shape.
  int block_of(const Element& element, CellShape shape);
  void add_cell(const Element& element, CellShape shape, const std::vector<Corner>& corners);
  void add_sides(const Element& element, CellShape shape, const std::vector<Corner>& corners,
                 const GlobalMesh::Side& cell);
  /// The node of the mesh over a node of the plane at a level (a layer's start, or the middle of a quadratic layer).
  long long node(long long plane, int level);
  long long middle(const Element& element, const Corner& a, const Corner& b);
  int level(const Element& element, int end) const { return order_ * (element.layer + end); }
  bool fixed(const Element& element, int corner) const { return sweep_.fixed[element.nodes[corner]]; }
  void add_point_sets();

  const GlobalMesh& plane_;
  const Sweep& sweep_;
  int order_, levels_;
  bool complete_ = false;  // the plane has quadrilaterals of second order, and the mesh sides of 9 nodes
  std::map<std::pair<int, CellShape>, int> blocks_;                    // by block of the plane and shape of the cells
  std::map<std::array<long long, 3>, std::vector<std::string>> sets_;  // by block, element and side of the plane
  std::vector<long long> numbers_;                                     // (level, plane node), -1: not used so far
  GlobalMesh mesh_;
};

Sweeper::Sweeper(const GlobalMesh& plane, const Sweep& sweep)
    : plane_(plane), sweep_(sweep), order_(order(plane.blocks.front().shape)) {
  constexpr double most_cells = 5e6;  // some 2 GB on the first rank
  double elements = 0;
  for (const auto& block : plane.blocks) elements += static_cast<double>(block.nodes.size()) / num_nodes(block.shape);
  if (elements * sweep.layers > most_cells)
    throw InputError("its " + number_text(elements) + " elements in " + std::to_string(sweep.layers) +
                     " layers are more than " + number_text(most_cells) + " cells");
  for (const auto& block : plane.blocks) complete_ = complete_ || (order_ == 2 && !is_simplex(block.shape));
  levels_ = order_ * sweep.layers + (sweep.closed ? 0 : 1);
  numbers_.assign(plane.coordinates.size() * levels_, -1);
  for (const auto& [name, sides] : plane.side_sets)
    for (const auto& side : sides) sets_[{side.block, side.element, side.side}].push_back(name);
  for (const char* end : {"start", "end"})
    if (!sweep.closed && (plane.side_sets.count(end) != 0 || plane.node_sets.count(end) != 0))
      throw InputError("it has a set called '" + std::string(end) + "', the name of the faces at that end");
}

long long Sweeper::node(long long plane, int level) {
  if (sweep_.fixed[plane]) level = 0;
  level %= levels_;
  long long& number = numbers_[level * plane_.coordinates.size() + plane];
  if (number >= 0) return number;
  number = static_cast<long long>(mesh_.coordinates.size());
  mesh_.coordinates.push_back(sweep_.place(plane_.coordinates[plane], static_cast<double>(level) / order_));
  return number;
}

/// Cuts the prism over a triangle into three tetrahedra. Every cut goes from the start of the corner with the lower
/// number to the end of the other one. The tetrahedron that stands on a fixed corner is flat and left out.
std::vector<std::vector<Corner>> Sweeper::cut_prism(const Element& element) const {
  int v[3] = {0, 1, 2};
  std::sort(v, v + 3, [&](int a, int b) { return element.nodes[a] < element.nodes[b]; });
  const bool odd = (v[1] - v[0] + 3) % 3 != 1;  // the sorted corners are clockwise
  std::vector<std::vector<Corner>> result;
  for (int upright = 0; upright < 3; ++upright) {
    if (fixed(element, v[upright])) continue;
    std::vector<Corner> corners;
    for (int i = 0; i <= upright; ++i) corners.push_back({v[i], 0});
    for (int i = upright; i < 3; ++i) corners.push_back({v[i], 1});
    if ((odd != (upright == 1)) != sweep_.turned) std::swap(corners[2], corners[3]);
    result.push_back(std::move(corners));
  }
  return result;
}

/// The mid-side node of an edge between two corners of a cell.
long long Sweeper::middle(const Element& element, const Corner& a, const Corner& b) {
  int local = a.node;
  if (a.node != b.node)
    for (int e = 0; e < num_edges(element.shape); ++e) {
      const std::array<int, 2>& ends = edge_corners(element.shape, e);
      if ((ends[0] == a.node && ends[1] == b.node) || (ends[1] == a.node && ends[0] == b.node))
        local = num_corners(element.shape) + e;
    }
  const int at_a = level(element, a.end), at_b = level(element, b.end);
  int at = (at_a + at_b) / 2;
  if (fixed(element, a.node)) at = at_b;
  if (fixed(element, b.node)) at = at_a;
  if (fixed(element, a.node) && fixed(element, b.node) && !sweep_.fixed[element.nodes[local]])
    throw InputError("its side from " + place_text(plane_.coordinates[element.nodes[a.node]], 2) + " to " +
                     place_text(plane_.coordinates[element.nodes[b.node]], 2) +
                     " ends on the axis but its middle is not on it");
  return node(element.nodes[local], at);
}

int Sweeper::block_of(const Element& element, CellShape shape) {
  const auto [known, added] = blocks_.emplace(std::pair{element.block, shape}, static_cast<int>(mesh_.blocks.size()));
  if (added) mesh_.blocks.push_back({plane_.blocks[element.block].region, shape, {}});
  return known->second;
}

void Sweeper::add_cell(const Element& element, CellShape shape, const std::vector<Corner>& corners) {
  const int number = block_of(element, shape);
  GlobalMesh::Block& block = mesh_.blocks[number];
  const auto cell = static_cast<long long>(block.nodes.size()) / num_nodes(shape);
  for (int a = 0; a < num_nodes(shape); ++a) {
    const std::vector<int>& around = corners_around(shape, a);
    if (around.size() == 1) {
      block.nodes.push_back(node(element.nodes[corners[a].node], level(element, corners[a].end)));
    } else if (around.size() == 2) {
      block.nodes.push_back(middle(element, corners[around[0]], corners[around[1]]));
    } else {  // centre of a face or of the cell, over a side or the centre of the plane's element
      std::set<int> below;
      int ends = 0, moving = 0;
      for (const int c : around) {
        below.insert(corners[c].node);
        if (fixed(element, corners[c].node)) continue;
        ends += corners[c].end;
        ++moving;
      }
      const int at = order_ * element.layer + 2 * ends / moving;
      if (below.size() == 2)
        block.nodes.push_back(middle(element, {*below.begin(), 0}, {*below.rbegin(), 1}));
      else
        block.nodes.push_back(node(element.nodes[num_nodes(element.shape) - 1], at));
    }
  }
  add_sides(element, shape, corners, {number, cell, 0});
}

void Sweeper::add_sides(const Element& element, CellShape shape, const std::vector<Corner>& corners,
                        const GlobalMesh::Side& cell) {
  for (int side = 0; side < num_sides(shape); ++side) {
    std::set<int> below;
    bool start = true, end = true;
    for (const int c : side_nodes(linear_partner(shape), side)) {
      below.insert(corners[c].node);
      if (fixed(element, corners[c].node)) continue;
      (corners[c].end == 0 ? end : start) = false;
    }
    const GlobalMesh::Side here{cell.block, cell.element, side};
    if (below.size() > 2) {
      if (sweep_.closed) continue;
      if (start && element.layer == 0) mesh_.side_sets["start"].push_back(here);
      if (end && element.layer == sweep_.layers - 1) mesh_.side_sets["end"].push_back(here);
      continue;
    }
    for (int s = 0; s < num_sides(element.shape); ++s) {
      const std::vector<int>& ends = side_nodes(linear_partner(element.shape), s);
      if (below != std::set<int>(ends.begin(), ends.end())) continue;
      const auto names = sets_.find({element.block, element.number, s});
      if (names == sets_.end()) continue;
      for (const std::string& name : names->second) mesh_.side_sets[name].push_back(here);
    }
  }
}

void Sweeper::add_point_sets() {
  const auto add = [&](const std::string& name, const std::vector<long long>& nodes) {
    auto& set = mesh_.node_sets[name];
    for (int level = 0; level < levels_; ++level)
      for (const long long plane : nodes) {
        const long long number = numbers_[level * plane_.coordinates.size() + plane];
        if (number >= 0) set.push_back(number);
      }
    std::sort(set.begin(), set.end());
    set.erase(std::unique(set.begin(), set.end()), set.end());
  };
  for (const auto& [name, nodes] : plane_.node_sets) add(name, nodes);
  for (const auto& [name, sides] : plane_.side_sets) {
    if (mesh_.side_sets.count(name) != 0) continue;  // otherwise none of its sides moves
    std::vector<long long> nodes;
    for (const auto& side : sides) {
      const auto& block = plane_.blocks[side.block];
      for (const int a : side_nodes(block.shape, side.side))
        nodes.push_back(block.nodes[side.element * num_nodes(block.shape) + a]);
    }
    add(name, nodes);
  }
}

int Sweeper::count_fixed(const Element& element) const {
  int count = 0;
  for (int c = 0; c < num_corners(element.shape); ++c) count += fixed(element, c);
  return count;
}

void Sweeper::refuse(const Element& element, const std::string& what, const std::string& remedy) const {
  int corner = 0;
  while (!fixed(element, corner)) ++corner;
  throw InputError("its " + what + " with a corner at " + place_text(plane_.coordinates[element.nodes[corner]], 2) +
                   " touches the axis with that corner only, " + remedy);
}

std::vector<Corner> Sweeper::drawn(const Element& element) const {
  std::vector<Corner> corners;
  for (int end = 0; end < 2; ++end)
    for (int c = 0; c < num_corners(element.shape); ++c) corners.push_back({c, sweep_.turned ? 1 - end : end});
  return corners;
}

void Sweeper::sweep_triangle(const Element& element) {
  const int on_axis = count_fixed(element);
  if (sweep_.wedges && on_axis == 0)
    return add_cell(element, swept_shape(element.shape, true, complete_), drawn(element));
  if (sweep_.wedges && on_axis == 1)
    refuse(element, "triangle", "where a wedge would become a pyramid; let 'triangles become' tetrahedra");
  for (const auto& corners : cut_prism(element)) add_cell(element, swept_shape(element.shape, false, false), corners);
}

/// A quadrilateral with a side on the axis becomes a wedge that stands on that side, with an end at each of its
/// corners.
void Sweeper::sweep_quadrilateral(const Element& element) {
  const int on_axis = count_fixed(element);
  if (on_axis == 0) return add_cell(element, swept_shape(element.shape, false, complete_), drawn(element));
  int first = 0;
  while (first < 4 && !(fixed(element, first) && fixed(element, (first + 1) % 4))) ++first;
  if (on_axis != 2 || first == 4) refuse(element, "quadrilateral", "where it would collapse; use triangles there");
  const int last = (first + 3) % 4, next = (first + 1) % 4, across = (first + 2) % 4, start = sweep_.turned ? 1 : 0;
  const std::vector<Corner> corners{{first, 0}, {last, start},   {last, 1 - start},
                                    {next, 0},  {across, start}, {across, 1 - start}};
  add_cell(element, order_ == 1 ? CellShape::wedge6 : CellShape::wedge18, corners);
}

GlobalMesh Sweeper::mesh() {
  for (int layer = 0; layer < sweep_.layers; ++layer)
    for (std::size_t b = 0; b < plane_.blocks.size(); ++b) {
      const auto& block = plane_.blocks[b];
      const long long n = num_nodes(block.shape), count = static_cast<long long>(block.nodes.size()) / n;
      for (long long e = 0; e < count; ++e) {
        const Element element{static_cast<int>(b), e, block.shape, block.nodes.data() + e * n, layer};
        is_simplex(block.shape) ? sweep_triangle(element) : sweep_quadrilateral(element);
      }
    }
  add_point_sets();
  return std::move(mesh_);
}

}  // namespace

GlobalMesh swept(const GlobalMesh& plane, const Sweep& sweep) { return Sweeper(plane, sweep).mesh(); }

bool has_pointed_triangle(const GlobalMesh& plane, const std::vector<char>& fixed) {
  for (const auto& block : plane.blocks) {
    if (!is_simplex(block.shape)) continue;
    for (std::size_t first = 0; first < block.nodes.size(); first += num_nodes(block.shape)) {
      const long long* corner = block.nodes.data() + first;
      if (fixed[corner[0]] + fixed[corner[1]] + fixed[corner[2]] == 1) return true;
    }
  }
  return false;
}

void PlaneMesh::parameters(Parameters& p) {
  p.passes_on("plane", "The plane mesh that is swept: a mesh source of type 'box' or 'gmsh', without 'geometry'");
  p.choice("triangles become", triangles_,
           {{"automatic", Triangles::automatic}, {"wedges", Triangles::wedges}, {"tetrahedra", Triangles::tetrahedra}},
           "wedges, one for each triangle and layer, or three tetrahedra each, which remeshing needs; automatic: "
           "wedges, unless a triangle touches the axis with one corner only");
}

bool PlaneMesh::makes_wedges(const GlobalMesh& plane, const std::vector<char>& fixed) const {
  if (triangles_ == Triangles::automatic) return !has_pointed_triangle(plane, fixed);
  return triangles_ == Triangles::wedges;
}

void PlaneMesh::read(const Section& section) {
  if (!section.has_section("plane"))
    section.fail("required section 'plane' is missing: the plane mesh that is swept, of type 'box' or 'gmsh'");
  section_ = std::make_shared<Section>(section.section("plane"));
  for (const char* entry : {"geometry", "cracks"})
    if (section_->has_parameter(entry))
      section_->fail("belongs to the section 'mesh'; the mesh that is swept is one of the plane", entry);
  Registry<MeshSource> sources("plane mesh");
  register_plane_sources(sources);
  source_ = sources.create(*section_);
}

GlobalMesh PlaneMesh::generate(Geometry geometry) const {
  GlobalMesh mesh = source_->generate();
  return at_section([&] {
    check_mesh(mesh, geometry);
    return std::move(mesh);
  });
}

GlobalMesh PlaneMesh::at_section(const std::function<GlobalMesh()>& make) const {
  try {
    return make();
  } catch (const InputError& error) {
    section_->fail(error.what());
  }
}

void require_space(const Section& section, Geometry geometry, const std::string& what) {
  if (dimension(geometry) == 3) return;
  section.fail(what + " is one of space: give the geometry 'three-dimensional'",
               section.has_parameter("geometry") ? "geometry" : "type");
}

}  // namespace mudline
