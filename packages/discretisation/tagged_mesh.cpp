#include "discretisation/tagged_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <unordered_map>

#include "core/errors.hpp"
#include "core/text.hpp"
#include "discretisation/centre_nodes.hpp"
#include "discretisation/mesh_topology.hpp"
#include "discretisation/msh_element.hpp"
#include "discretisation/space_filling_curve.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

using Tag = TaggedMesh::Tag;

/// A block while its nodes still have the file's numbers.
struct TaggedBlock {
  std::string region;
  CellShape shape;
  std::vector<Tag> nodes;
};

CellShape cell_shape(int type, int order, int dimension, const std::string& region) {
  const std::optional<CellShape> shape = cell_of(type);
  if (!shape) {
    const MshElement* const known = msh_element(type);
    throw InputError("region '" + region + "' has elements of the type " +
                     (known == nullptr ? std::to_string(type) : "'" + std::string(known->name) + "'") + "; allowed: " +
                     (dimension == 2 ? "triangles of 3 or 6 nodes, quadrilaterals of 4, 8 or 9"
                                     : "tetrahedra of 4 or 10 nodes, hexahedra of 8, 20 or 27, prisms of 6, 15 or 18"));
  }
  if (mudline::order(*shape) != order)
    throw InputError("region '" + region + "' has " + name(*shape) + " elements, which are of order " +
                     std::to_string(mudline::order(*shape)) + ", but 'order' is " + std::to_string(order));
  return *shape;
}

/// 15-node prisms have sides of 8 nodes. They stay as they are unless the mesh has sides of 9 nodes.
bool needs_complete_prisms(const TaggedMesh& tagged) {
  return std::any_of(tagged.cells.begin(), tagged.cells.end(), [](const TaggedMesh::Cells& cells) {
    const std::optional<CellShape> shape = cell_of(cells.type);
    return shape == CellShape::hex27 || shape == CellShape::wedge18;
  });
}

/// For each node, the node of the same cell with its first two reference coordinates exchanged (turned over).
std::vector<int> turned_over(CellShape shape) {
  std::vector<int> result;
  for (int a = 0; a < num_nodes(shape); ++a) {
    Vec<double, 3> place = reference_node(shape, a);
    std::swap(place[0], place[1]);
    for (int b = 0; b < num_nodes(shape); ++b) {
      const Vec<double, 3> other = reference_node(shape, b);
      const double off = std::abs(place[0] - other[0]) + std::abs(place[1] - other[1]) + std::abs(place[2] - other[2]);
      if (off < 1e-6) result.push_back(b);
    }
  }
  return result;
}

class Numbering {
 public:
  Numbering(const TaggedMesh& tagged, int order, int dimension)
      : tagged_(tagged), order_(order), dimension_(dimension) {}
  GlobalMesh number();

 private:
  void take_nodes();
  void take_cells();
  void turn_over(TaggedBlock& block) const;
  void sort_along_curve(TaggedBlock& block) const;
  void number_nodes();
  void index_sides();
  void take_sides();
  void take_points(const std::map<std::string, std::vector<Tag>>& sets, const std::string& kind);
  const Point& point(Tag tag) const { return points_.at(tag); }
  GlobalMesh::Side side_of(const Tag* corners, int count, const std::string& set) const;
  std::string text(const Point& place) const { return tuple_text(place.data(), dimension_); }
  bool plane() const { return dimension_ == 2; }

  const TaggedMesh& tagged_;
  int order_, dimension_;
  std::unordered_map<Tag, Point> points_;
  std::vector<TaggedBlock> blocks_;
  std::unordered_map<Tag, long long> numbers_;
  std::unordered_map<SideKey, GlobalMesh::Side, SideKeyHash> sides_;  // by directed keys
  GlobalMesh mesh_;
};

GlobalMesh Numbering::number() {
  take_nodes();
  take_cells();
  for (TaggedBlock& block : blocks_) {
    turn_over(block);
    sort_along_curve(block);
  }
  number_nodes();
  index_sides();
  take_sides();
  take_points(tagged_.points, "point");
  take_points(tagged_.curves, "curve");
  return std::move(mesh_);
}

void Numbering::take_nodes() {
  for (const TaggedMesh::Node& node : tagged_.nodes) {
    const Point& x = node.place;
    points_[node.tag] = {x[0], x[1], plane() ? 0 : x[2]};
    const double size = std::max(std::abs(x[0]), std::abs(x[1]));
    if (plane() && std::abs(x[2]) > 1e-9 * size)
      throw InputError("the mesh is not in the x-y plane: it has a node at " + tuple_text(&x[0], 3));
  }
}

void Numbering::take_cells() {
  const bool complete = needs_complete_prisms(tagged_);
  for (const TaggedMesh::Cells& cells : tagged_.cells) {
    if (cells.region.empty())
      throw InputError("the " + std::to_string(cells.nodes.size() / msh_element(cells.type)->nodes) + " elements of " +
                       cells.entity + " belong to no physical group; add a Physical " +
                       (plane() ? "Surface" : "Volume") + " for each region");
    CellShape shape = cell_shape(cells.type, order_, dimension_, cells.region);
    if (shape == CellShape::wedge15 && complete) shape = CellShape::wedge18;
    auto block = std::find_if(blocks_.begin(), blocks_.end(),
                              [&](const TaggedBlock& b) { return b.region == cells.region && b.shape == shape; });
    if (block == blocks_.end()) block = blocks_.insert(blocks_.end(), TaggedBlock{cells.region, shape, {}});
    const std::vector<int> order = order_of_nodes(cells.type, shape);
    const std::size_t given = msh_element(cells.type)->nodes;
    for (std::size_t first = 0; first < cells.nodes.size(); first += given)
      for (const int a : order) block->nodes.push_back(a < 0 ? CentreNodes::missing : cells.nodes[first + a]);
  }
  if (blocks_.empty())
    throw InputError("there are no " + std::string(plane() ? "two" : "three") + "-dimensional elements in it");
  CentreNodes centres(points_);
  for (const TaggedBlock& block : blocks_) centres.note(block.shape, block.nodes);
  for (TaggedBlock& block : blocks_) centres.add(block.shape, block.nodes);
}

/// Turns elements over. A surface of Gmsh may face down, so that its elements run clockwise, and volumes swept
/// backwards have negative elements.
void Numbering::turn_over(TaggedBlock& block) const {
  const int n = num_nodes(block.shape);
  const CellShape straight = linear_partner(block.shape);
  const std::vector<int> turned = turned_over(block.shape);
  for (std::size_t first = 0; first < block.nodes.size(); first += n) {
    Tag* nodes = block.nodes.data() + first;
    const ElementMap map(straight, [&](int c) { return point(nodes[c]); });
    if (map.determinant(cell_centre(straight).data()) >= 0) continue;
    const std::vector<Tag> old(nodes, nodes + n);
    for (int a = 0; a < n; ++a) nodes[a] = old[turned[a]];
  }
}

void Numbering::sort_along_curve(TaggedBlock& block) const {
  const int n = num_nodes(block.shape);
  const CellShape straight = linear_partner(block.shape);
  const std::size_t elements = block.nodes.size() / n;
  Bounds bounds = Bounds::nothing();
  std::vector<Point> centres;
  for (std::size_t e = 0; e < elements; ++e) {
    centres.push_back(ElementMap(straight, [&](int c) { return point(block.nodes[e * n + c]); }).mean_of_corners());
    bounds.enclose(centres.back());
  }
  const double extent = std::max(bounds.extent(), std::numeric_limits<double>::min());
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t e = 0; e < elements; ++e) {
    double t[3];
    for (int d = 0; d < 3; ++d) t[d] = (centres[e][d] - bounds.low[d]) / extent;
    order.emplace_back(along_curve(t, dimension_), e);
  }
  std::sort(order.begin(), order.end());
  std::vector<Tag> sorted;
  for (const auto& item : order)
    sorted.insert(sorted.end(), block.nodes.begin() + item.second * n, block.nodes.begin() + (item.second + 1) * n);
  block.nodes = std::move(sorted);
}

void Numbering::number_nodes() {
  for (const TaggedBlock& block : blocks_) {
    GlobalMesh::Block numbered{block.region, block.shape, {}};
    for (Tag tag : block.nodes) {
      const auto [number, added] = numbers_.emplace(tag, static_cast<long long>(mesh_.coordinates.size()));
      if (added) mesh_.coordinates.push_back(point(tag));
      numbered.nodes.push_back(number->second);
    }
    mesh_.blocks.push_back(std::move(numbered));
  }
}

void Numbering::index_sides() {
  for_each_side(mesh_, [&](const GlobalMesh::Side& place, const std::vector<long long>& nodes) {
    const int corners = num_corners(side_shape(mesh_.blocks[place.block].shape, place.side));
    sides_.emplace(directed_key(nodes.data(), corners), place);
  });
}

GlobalMesh::Side Numbering::side_of(const Tag* corners, int count, const std::string& set) const {
  std::vector<long long> nodes;
  for (int c = 0; c < count; ++c) {
    const auto number = numbers_.find(corners[c]);
    if (number != numbers_.end()) nodes.push_back(number->second);
  }
  if (static_cast<int>(nodes.size()) == count) {
    const SideKey key = directed_key(nodes.data(), count);
    auto found = sides_.find(key);
    if (found == sides_.end()) found = sides_.find(reversed_key(key));
    if (found != sides_.end()) return found->second;
  }
  throw InputError("the " + std::string(plane() ? "curve" : "surface") + " group '" + set + "' has a " +
                   (plane() ? "line" : "face") + " from " + text(point(corners[0])) + " to " + text(point(corners[1])) +
                   (plane() ? "" : " and " + text(point(corners[2]))) + " that is no side of an element");
}

void Numbering::take_sides() {
  for (const TaggedMesh::Sides& group : tagged_.sides) {
    auto& sides = mesh_.side_sets[group.set];
    for (std::size_t first = 0; first < group.nodes.size(); first += group.corners)
      sides.push_back(side_of(group.nodes.data() + first, group.corners, group.set));
  }
}

void Numbering::take_points(const std::map<std::string, std::vector<Tag>>& sets, const std::string& kind) {
  for (const auto& [set, tags] : sets) {
    auto& nodes = mesh_.node_sets[set];
    for (const Tag tag : tags) {
      const auto number = numbers_.find(tag);
      if (number == numbers_.end())
        throw InputError("the " + kind + " group '" + set + "' has a point at " + text(point(tag)) +
                         " that no element uses");
      nodes.push_back(number->second);
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
}

}  // namespace

GlobalMesh global_mesh(const TaggedMesh& tagged, int order, int dimension) {
  return Numbering(tagged, order, dimension).number();
}

std::string elements_without_centres(const TaggedMesh& tagged) {
  std::size_t quadrilaterals = 0, hexahedra = 0, prisms = 0;
  for (const TaggedMesh::Cells& cells : tagged.cells) {
    if (cells.type == 16) quadrilaterals += cells.nodes.size() / 8;
    if (cells.type == 17) hexahedra += cells.nodes.size() / 20;
    if (cells.type == 18 && needs_complete_prisms(tagged)) prisms += cells.nodes.size() / 15;
  }
  const auto told = [](std::size_t count, const std::string& one, const std::string& more, const std::string& nodes) {
    return std::to_string(count) + " " + (count == 1 ? one : more) + " of " + nodes + " nodes";
  };
  if (quadrilaterals > 0) return told(quadrilaterals, "quadrilateral", "quadrilaterals", "8");
  if (hexahedra > 0) return told(hexahedra, "hexahedron", "hexahedra", "20");
  return prisms > 0 ? told(prisms, "prism", "prisms", "15") : "";
}

}  // namespace mudline
