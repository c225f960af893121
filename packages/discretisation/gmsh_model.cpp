#include "discretisation/gmsh_model.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "core/errors.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

using Tag = std::size_t;
using Point = std::array<double, 2>;

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

CellShape cell_shape(int type, int order, const std::string& region) {
  CellShape shape{};
  switch (type) {
    case 2:
      shape = CellShape::tri3;
      break;
    case 3:
      shape = CellShape::quad4;
      break;
    case 9:
      shape = CellShape::tri6;
      break;
    case 10:
      shape = CellShape::quad9;
      break;
    case 16:
      throw InputError("region '" + region + "' has 8-node quadrilaterals, which have no stable pressure partner; " +
                       "remove Mesh.SecondOrderIncomplete to get 9 nodes");
    default: {
      std::string name;
      int dimension = 0, degree = 0, nodes = 0, primary = 0;
      std::vector<double> local;
      gmsh::model::mesh::getElementProperties(type, name, dimension, degree, nodes, local, primary);
      throw InputError("region '" + region + "' has elements of the type '" + name +
                       "'; allowed: triangles of 3 or 6 nodes, quadrilaterals of 4 or 9");
    }
  }
  if (mudline::order(shape) != order)
    throw InputError("region '" + region + "' has " + name(shape) + " elements, which are of order " +
                     std::to_string(mudline::order(shape)) + ", but 'order' is " + std::to_string(order));
  return shape;
}

class Reader {
 public:
  explicit Reader(int order) : order_(order) {}
  GlobalMesh read();

 private:
  void read_nodes();
  void read_regions();
  void read_surface(int entity, const std::string& region);
  void turn_over(TaggedBlock& block) const;
  void sort_along_curve(TaggedBlock& block) const;
  void number_nodes();
  void read_sides();
  void index_sides();
  void read_points();
  const Point& point(Tag tag) const { return points_.at(tag); }
  Point centre(const TaggedBlock& block, std::size_t first) const;
  GlobalMesh::Side side_of(Tag start, Tag end, const std::string& set) const;

  int order_;
  std::unordered_map<Tag, Point> points_;
  std::vector<TaggedBlock> blocks_;
  std::unordered_map<Tag, long long> numbers_;
  std::map<std::pair<long long, long long>, GlobalMesh::Side> sides_;  // by their ends in counter-clockwise direction
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
  read_points();
  return std::move(mesh_);
}

void Reader::read_nodes() {
  std::vector<Tag> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const double* x = coordinates.data() + 3 * i;
    points_[tags[i]] = {x[0], x[1]};
    const double size = std::max(std::abs(x[0]), std::abs(x[1]));
    if (std::abs(x[2]) > 1e-9 * size)
      throw InputError("the mesh is not in the x-y plane: it has a node at (" + number_text(x[0]) + ", " +
                       number_text(x[1]) + ", " + number_text(x[2]) + ")");
  }
}

void Reader::read_regions() {
  std::map<int, std::string> region_of;
  for (const auto& [region, entities] : groups(2))
    for (int entity : entities) {
      const auto [known, added] = region_of.emplace(entity, region);
      if (!added)
        throw InputError("surface " + std::to_string(entity) + " is in two physical groups, '" + known->second +
                         "' and '" + region + "'; each element needs exactly one");
    }
  gmsh::vectorpair surfaces;
  gmsh::model::getEntities(surfaces, 2);
  for (const auto& surface : surfaces) {
    const auto region = region_of.find(surface.second);
    read_surface(surface.second, region == region_of.end() ? "" : region->second);
  }
  if (blocks_.empty()) throw InputError("there are no two-dimensional elements in it");
}

void Reader::read_surface(int entity, const std::string& region) {
  std::vector<int> types;
  std::vector<std::vector<Tag>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, 2, entity);
  for (std::size_t t = 0; t < types.size(); ++t) {
    if (tags[t].empty()) continue;
    if (region.empty())
      throw InputError("the " + std::to_string(tags[t].size()) + " elements of surface " + std::to_string(entity) +
                       " belong to no physical group; add a Physical Surface for each region");
    const CellShape shape = cell_shape(types[t], order_, region);
    auto block = std::find_if(blocks_.begin(), blocks_.end(), [&, &name = region](const TaggedBlock& b) {
      return b.region == name && b.shape == shape;
    });
    if (block == blocks_.end()) block = blocks_.insert(blocks_.end(), TaggedBlock{region, shape, {}});
    block->nodes.insert(block->nodes.end(), nodes[t].begin(), nodes[t].end());
  }
}

Point Reader::centre(const TaggedBlock& block, std::size_t first) const {
  Point sum{0, 0};
  const int n = num_corners(block.shape);
  for (int c = 0; c < n; ++c)
    for (int d = 0; d < 2; ++d) sum[d] += point(block.nodes[first + c])[d] / n;
  return sum;
}

/// A surface of Gmsh may face down; its elements then run clockwise.
void Reader::turn_over(TaggedBlock& block) const {
  const int n = num_nodes(block.shape), corners = num_corners(block.shape);
  for (std::size_t first = 0; first < block.nodes.size(); first += n) {
    Tag* nodes = block.nodes.data() + first;
    double area = 0;
    const Point& origin = point(nodes[0]);
    for (int c = 1; c + 1 < corners; ++c) {
      const Point &a = point(nodes[c]), &b = point(nodes[c + 1]);
      area += (a[0] - origin[0]) * (b[1] - origin[1]) - (b[0] - origin[0]) * (a[1] - origin[1]);
    }
    if (area >= 0) continue;
    std::reverse(nodes + 1, nodes + corners);
    if (n > corners) std::reverse(nodes + corners, nodes + 2 * corners);
  }
}

/// Position of a point of the unit square along Hilbert's curve.
std::uint64_t along_curve(double x, double y) {
  constexpr std::uint32_t cells = 1u << 16;
  const auto cell = [](double t) {
    return static_cast<std::uint32_t>(std::min(std::max(t, 0.0) * cells, cells - 1.0));
  };
  std::uint32_t a = cell(x), b = cell(y);
  std::uint64_t position = 0;
  for (std::uint32_t s = cells / 2; s > 0; s /= 2) {
    const std::uint32_t right = (a & s) != 0, upper = (b & s) != 0;
    position += static_cast<std::uint64_t>(s) * s * ((3 * right) ^ upper);
    if (upper == 0) {
      if (right == 1) {
        a = cells - 1 - a;
        b = cells - 1 - b;
      }
      std::swap(a, b);
    }
  }
  return position;
}

void Reader::sort_along_curve(TaggedBlock& block) const {
  const int n = num_nodes(block.shape);
  const std::size_t elements = block.nodes.size() / n;
  constexpr double huge = std::numeric_limits<double>::max();
  Point low{huge, huge}, high{-huge, -huge};
  std::vector<Point> centres;
  for (std::size_t e = 0; e < elements; ++e) {
    centres.push_back(centre(block, e * n));
    for (int d = 0; d < 2; ++d) {
      low[d] = std::min(low[d], centres.back()[d]);
      high[d] = std::max(high[d], centres.back()[d]);
    }
  }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], std::numeric_limits<double>::min()});
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t e = 0; e < elements; ++e)
    order.emplace_back(along_curve((centres[e][0] - low[0]) / extent, (centres[e][1] - low[1]) / extent), e);
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
  for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
    const auto& block = mesh_.blocks[b];
    const int n = num_nodes(block.shape), sides = num_sides(block.shape);
    for (std::size_t first = 0; first < block.nodes.size(); first += n)
      for (int s = 0; s < sides; ++s)
        sides_.emplace(std::pair{block.nodes[first + s], block.nodes[first + (s + 1) % sides]},
                       GlobalMesh::Side{static_cast<int>(b), static_cast<long long>(first / n), s});
  }
}

GlobalMesh::Side Reader::side_of(Tag start, Tag end, const std::string& set) const {
  const auto a = numbers_.find(start), b = numbers_.find(end);
  if (a != numbers_.end() && b != numbers_.end()) {
    auto found = sides_.find({a->second, b->second});
    if (found == sides_.end()) found = sides_.find({b->second, a->second});
    if (found != sides_.end()) return found->second;
  }
  const Point &p = point(start), &q = point(end);
  throw InputError("the curve group '" + set + "' has a line from (" + number_text(p[0]) + ", " + number_text(p[1]) +
                   ") to (" + number_text(q[0]) + ", " + number_text(q[1]) + ") that is no side of an element");
}

void Reader::read_sides() {
  for (const auto& [set, entities] : groups(1)) {
    auto& sides = mesh_.side_sets[set];
    for (int entity : entities) {
      std::vector<int> types;
      std::vector<std::vector<Tag>> tags, nodes;
      gmsh::model::mesh::getElements(types, tags, nodes, 1, entity);
      for (std::size_t t = 0; t < types.size(); ++t) {
        if (tags[t].empty()) continue;
        const std::size_t n = nodes[t].size() / tags[t].size();  // the two ends come first in every order
        for (std::size_t first = 0; first < nodes[t].size(); first += n)
          sides.push_back(side_of(nodes[t][first], nodes[t][first + 1], set));
      }
    }
  }
}

void Reader::read_points() {
  for (const auto& [set, entities] : groups(0)) {
    auto& nodes = mesh_.node_sets[set];
    for (int entity : entities) {
      std::vector<Tag> tags;
      std::vector<double> coordinates, parameters;
      gmsh::model::mesh::getNodes(tags, coordinates, parameters, 0, entity);
      for (Tag tag : tags) {
        const auto number = numbers_.find(tag);
        if (number == numbers_.end())
          throw InputError("the point group '" + set + "' has a point at (" + number_text(point(tag)[0]) + ", " +
                           number_text(point(tag)[1]) + ") that no element uses");
        nodes.push_back(number->second);
      }
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
}

}  // namespace

GlobalMesh read_gmsh_model(int order) { return Reader(order).read(); }

}  // namespace mudline
