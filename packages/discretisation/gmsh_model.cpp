#include "discretisation/gmsh_model.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <unordered_map>

#include "core/errors.hpp"
#include "core/text.hpp"
#include "discretisation/mesh_topology.hpp"
#include "discretisation/space_filling_curve.hpp"

namespace mudline {

namespace {

using Tag = std::size_t;

/// A block while its nodes still have Gmsh's tags.
struct TaggedBlock {
  std::string region;
  CellShape shape;
  std::vector<Tag> nodes;
};

std::string group_name(int dimension, int tag) {
  std::string name;
  gmsh::model::getPhysicalName(dimension, tag, name);
  return name.empty() ? std::to_string(tag) : name;
}

/// Name of the physical group -> its entities, for one dimension; groups of one name are one group.
std::map<std::string, std::vector<int>> groups(int dimension) {
  gmsh::vectorpair list;
  gmsh::model::getPhysicalGroups(list, dimension);
  std::map<std::string, std::vector<int>> result;
  for (const auto& group : list) {
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, group.second, entities);
    auto& all = result[group_name(dimension, group.second)];
    all.insert(all.end(), entities.begin(), entities.end());
  }
  for (auto& item : result) {
    std::sort(item.second.begin(), item.second.end());
    item.second.erase(std::unique(item.second.begin(), item.second.end()), item.second.end());
  }
  return result;
}

/// What Gmsh knows of a type of elements.
struct ElementType {
  std::string name;
  int dimension = 0, order = 0, nodes = 0, corners = 0;
  std::vector<double> places;  // (node, dimension) reference coordinates
  explicit ElementType(int type) {
    gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes, places, corners);
  }
};

constexpr std::pair<int, CellShape> cell_types[] = {{2, CellShape::tri3},   {3, CellShape::quad4}, {9, CellShape::tri6},
                                                    {10, CellShape::quad9}, {4, CellShape::tet4},  {5, CellShape::hex8},
                                                    {11, CellShape::tet10}, {12, CellShape::hex27}};

CellShape cell_shape(int type, int order, const std::string& region) {
  const auto known = std::find_if(std::begin(cell_types), std::end(cell_types),
                                  [&](const auto& candidate) { return candidate.first == type; });
  if (known == std::end(cell_types)) {
    const std::string start = "region '" + region + "' has ";
    constexpr int quad8 = 16, hex20 = 17;
    if (type == quad8 || type == hex20)
      throw InputError(start + (type == quad8 ? "8-node quadrilaterals" : "20-node hexahedra") +
                       ", which have no stable pressure partner; remove Mesh.SecondOrderIncomplete to get " +
                       (type == quad8 ? "9 nodes" : "27 nodes"));
    const ElementType other(type);
    throw InputError(start + "elements of the type '" + other.name + "'; allowed: " +
                     (other.dimension == 2 ? "triangles of 3 or 6 nodes, quadrilaterals of 4 or 9"
                                           : "tetrahedra of 4 or 10 nodes, hexahedra of 8 or 27"));
  }
  const CellShape shape = known->second;
  if (mudline::order(shape) != order)
    throw InputError("region '" + region + "' has " + name(shape) + " elements, which are of order " +
                     std::to_string(mudline::order(shape)) + ", but 'order' is " + std::to_string(order));
  return shape;
}

/// For each node of a cell the one of `places` (node, dimension) that has its reference coordinates.
std::vector<int> matching(CellShape shape, const std::vector<double>& places) {
  const int dim = dimension(shape), n = num_nodes(shape);
  std::vector<int> result;
  for (int a = 0; a < n; ++a) {
    const std::array<double, 3> own = reference_node(shape, a);
    for (int b = 0; b < n && static_cast<int>(result.size()) == a; ++b) {
      double off = 0;
      for (int d = 0; d < dim; ++d) off += std::abs(places[dim * b + d] - own[d]);
      if (off < 1e-6) result.push_back(b);
    }
    if (static_cast<int>(result.size()) == a) throw std::logic_error("Gmsh has other nodes in a cell than mudline");
  }
  return result;
}

/// The node of the same cell turned over: its first two reference coordinates are exchanged.
std::vector<int> turned_over(CellShape shape) {
  std::vector<double> places;
  for (int a = 0; a < num_nodes(shape); ++a) {
    std::array<double, 3> place = reference_node(shape, a);
    std::swap(place[0], place[1]);
    places.insert(places.end(), place.begin(), place.begin() + dimension(shape));
  }
  return matching(shape, places);
}

/// The nodes of all elements of a list, each in another order.
std::vector<Tag> reordered(const std::vector<Tag>& nodes, const std::vector<int>& order) {
  std::vector<Tag> result;
  for (std::size_t first = 0; first < nodes.size(); first += order.size())
    for (const int a : order) result.push_back(nodes[first + a]);
  return result;
}

class Reader {
 public:
  Reader(int order, int dimension) : order_(order), dimension_(dimension) {}
  GlobalMesh read();

 private:
  void read_nodes();
  void read_regions();
  void read_entity(int entity, const std::string& region);
  void turn_over(TaggedBlock& block) const;
  void sort_along_curve(TaggedBlock& block) const;
  void number_nodes();
  void read_sides();
  void index_sides();
  void read_points(int dimension);
  const Point& point(Tag tag) const { return points_.at(tag); }
  GlobalMesh::Side side_of(const Tag* corners, int count, const std::string& set) const;
  std::string text(const Point& place) const { return tuple_text(place.data(), dimension_); }
  bool plane() const { return dimension_ == 2; }

  int order_, dimension_;
  std::unordered_map<Tag, Point> points_;
  std::vector<TaggedBlock> blocks_;
  std::unordered_map<Tag, long long> numbers_;
  std::unordered_map<SideKey, GlobalMesh::Side, SideKeyHash> sides_;  // by directed keys
  GlobalMesh mesh_;
};

GlobalMesh Reader::read() {
  read_nodes();
  read_regions();
  for (TaggedBlock& block : blocks_) {
    turn_over(block);
    sort_along_curve(block);
  }
  number_nodes();
  index_sides();
  read_sides();
  read_points(0);
  if (!plane()) read_points(1);
  return std::move(mesh_);
}

void Reader::read_nodes() {
  std::vector<Tag> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const double* x = coordinates.data() + 3 * i;
    points_[tags[i]] = {x[0], x[1], plane() ? 0 : x[2]};
    const double size = std::max(std::abs(x[0]), std::abs(x[1]));
    if (plane() && std::abs(x[2]) > 1e-9 * size)
      throw InputError("the mesh is not in the x-y plane: it has a node at " + tuple_text(&x[0], 3));
  }
}

void Reader::read_regions() {
  std::map<int, std::string> region_of;
  for (const auto& [region, entities] : groups(dimension_))
    for (int entity : entities) {
      const auto [known, added] = region_of.emplace(entity, region);
      if (!added)
        throw InputError((plane() ? "surface " : "volume ") + std::to_string(entity) + " is in two physical groups, '" +
                         known->second + "' and '" + region + "'; each element needs exactly one");
    }
  gmsh::vectorpair all;
  gmsh::model::getEntities(all, dimension_);
  for (const auto& entity : all) {
    const auto region = region_of.find(entity.second);
    read_entity(entity.second, region == region_of.end() ? "" : region->second);
  }
  if (blocks_.empty())
    throw InputError("there are no " + std::string(plane() ? "two" : "three") + "-dimensional elements in it");
}

void Reader::read_entity(int entity, const std::string& region) {
  std::vector<int> types;
  std::vector<std::vector<Tag>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dimension_, entity);
  for (std::size_t t = 0; t < types.size(); ++t) {
    if (tags[t].empty()) continue;
    if (region.empty())
      throw InputError("the " + std::to_string(tags[t].size()) + " elements of " + (plane() ? "surface " : "volume ") +
                       std::to_string(entity) + " belong to no physical group; add a Physical " +
                       (plane() ? "Surface" : "Volume") + " for each region");
    const CellShape shape = cell_shape(types[t], order_, region);
    const std::vector<Tag> ordered = reordered(nodes[t], matching(shape, ElementType(types[t]).places));
    auto block = std::find_if(blocks_.begin(), blocks_.end(), [&, &name = region](const TaggedBlock& b) {
      return b.region == name && b.shape == shape;
    });
    if (block == blocks_.end()) block = blocks_.insert(blocks_.end(), TaggedBlock{region, shape, {}});
    block->nodes.insert(block->nodes.end(), ordered.begin(), ordered.end());
  }
}

/// A surface of Gmsh may face down; its elements then run clockwise. Volumes swept backwards have negative elements.
void Reader::turn_over(TaggedBlock& block) const {
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

void Reader::sort_along_curve(TaggedBlock& block) const {
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

void Reader::number_nodes() {
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

void Reader::index_sides() {
  for_each_side(mesh_, [&](const GlobalMesh::Side& place, const std::vector<long long>& nodes) {
    const int corners = num_corners(side_shape(mesh_.blocks[place.block].shape));
    sides_.emplace(directed_key(nodes.data(), corners), place);
  });
}

GlobalMesh::Side Reader::side_of(const Tag* corners, int count, const std::string& set) const {
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

void Reader::read_sides() {
  for (const auto& [set, entities] : groups(dimension_ - 1)) {
    auto& sides = mesh_.side_sets[set];
    for (int entity : entities) {
      std::vector<int> types;
      std::vector<std::vector<Tag>> tags, nodes;
      gmsh::model::mesh::getElements(types, tags, nodes, dimension_ - 1, entity);
      for (std::size_t t = 0; t < types.size(); ++t) {
        if (tags[t].empty()) continue;
        const ElementType type(types[t]);  // the corners come first in every order
        for (std::size_t first = 0; first < nodes[t].size(); first += type.nodes)
          sides.push_back(side_of(nodes[t].data() + first, type.corners, set));
      }
    }
  }
}

/// Groups of points, in space of curves too: their nodes.
void Reader::read_points(int dimension) {
  for (const auto& [set, entities] : groups(dimension)) {
    auto& nodes = mesh_.node_sets[set];
    for (int entity : entities) {
      std::vector<Tag> tags;
      std::vector<double> coordinates, parameters;
      gmsh::model::mesh::getNodes(tags, coordinates, parameters, dimension, entity, true);
      for (Tag tag : tags) {
        const auto number = numbers_.find(tag);
        if (number == numbers_.end())
          throw InputError("the " + std::string(dimension == 0 ? "point" : "curve") + " group '" + set +
                           "' has a point at " + text(point(tag)) + " that no element uses");
        nodes.push_back(number->second);
      }
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
}

}  // namespace

GlobalMesh read_gmsh_model(int order, int dimension) { return Reader(order, dimension).read(); }

}  // namespace mudline
