#include "ale/whole_mesh.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <unordered_map>

#include "discretisation/mesh_topology.hpp"

namespace mudline {

namespace {

/// Sum over ranks of tables in which every entry is set by one rank alone: exact, whatever the order of the sum.
template <class T>
std::vector<T> merge(const Mesh& mesh, const std::vector<T>& mine) {
  std::vector<T> all(mine.size());
  if (!mine.empty())
    Teuchos::reduceAll(*mesh.comm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

template <class T>
std::vector<T> merge_flags(const Mesh& mesh, const std::vector<T>& mine) {
  std::vector<T> all(mine.size());
  if (!mine.empty())
    Teuchos::reduceAll(*mesh.comm(), Teuchos::REDUCE_MAX, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

constexpr int most_sides = std::tuple_size<decltype(WholeMesh::Element::neighbours)>::value;

SideKey key_of(const WholeMesh::Element& element, int side) {
  long long corners[4];
  int count = 0;
  for (int a : side_nodes(linear_partner(element.shape), side)) corners[count++] = element.nodes[a];
  return sorted_key(corners, count);
}

}  // namespace

WholeMesh::WholeMesh(const Mesh& mesh) : mesh_(mesh) {
  const int count = static_cast<int>(mesh.num_global_elements());
  constexpr int width = 2 + std::tuple_size<decltype(Element::nodes)>::value;
  std::vector<int> table(static_cast<std::size_t>(count) * width, 0);
  for (std::size_t b = 0; b < mesh.blocks().size(); ++b) {
    const ElementBlock& block = mesh.blocks()[b];
    for (int e = 0; e < block.num_elements; ++e) {
      int* row = &table[block.global_ids[e] * width];
      row[0] = static_cast<int>(b);
      row[1] = static_cast<int>(block.shape);
      for (int a = 0; a < mudline::num_nodes(block.shape); ++a)
        row[2 + a] = static_cast<int>(mesh.node_ids()[block.nodes(e, a)]);
    }
  }
  table = merge(mesh, table);
  element_of_.assign(num_nodes(), -1);
  vertex_.assign(num_nodes(), 0);
  block_elements_.resize(mesh.blocks().size());
  std::unordered_map<SideKey, ElementSide, SideKeyHash> open;
  for (int e = 0; e < count; ++e) {
    const int* row = &table[e * width];
    Element element{static_cast<CellShape>(row[1]), row[0], {}, {-1, -1, -1, -1, -1, -1}};
    std::copy(row + 2, row + width, element.nodes.begin());
    for (int a = 0; a < mudline::num_nodes(element.shape); ++a) {
      if (element_of_[element.nodes[a]] < 0) element_of_[element.nodes[a]] = e;
      if (a < num_corners(element.shape)) vertex_[element.nodes[a]] = 1;
    }
    elements_.push_back(element);
    for (int s = 0; s < num_sides(element.shape); ++s) {
      const SideKey key = key_of(element, s);
      const auto found = open.find(key);
      if (found == open.end()) {
        open[key] = {e, s};
        continue;
      }
      elements_[e].neighbours[s] = found->second.element;
      elements_[found->second.element].neighbours[found->second.side] = e;
      open.erase(found);
    }
    place_in_block_.push_back(static_cast<int>(block_elements_[element.block].size()));
    block_elements_[element.block].push_back(e);
  }
  on_boundary_.assign(num_nodes(), 0);
  for (const Element& element : elements_)
    for (int s = 0; s < num_sides(element.shape); ++s)
      if (on_boundary(element, s))
        for (int a : side_nodes(element.shape, s)) on_boundary_[element.nodes[a]] = 1;
  for (const auto& [name, sides] : mesh.side_sets()) {
    std::vector<int> flags(static_cast<std::size_t>(count) * most_sides, 0);
    for (const Side& side : sides)
      flags[mesh.blocks()[side.block].global_ids[side.element] * most_sides + side.side] = 1;
    flags = merge(mesh, flags);
    std::vector<ElementSide>& to = side_sets_[name];
    for (std::size_t i = 0; i < flags.size(); ++i)
      if (flags[i]) to.push_back({static_cast<int>(i / most_sides), static_cast<int>(i % most_sides)});
  }
  for (const auto& [name, nodes] : mesh.node_sets()) {
    std::vector<int> flags(num_nodes(), 0);
    for (int node : nodes) flags[mesh.node_ids()[node]] = 1;
    flags = merge_flags(mesh, flags);
    std::vector<int>& to = node_sets_[name];
    for (int i = 0; i < num_nodes(); ++i)
      if (flags[i]) to.push_back(i);
  }
}

Positions WholeMesh::gather(const ConstCoordinateView& x) const {
  const int dim = dimension();
  std::vector<double> table(dim * static_cast<std::size_t>(num_nodes()), 0.0);
  for (int i = 0; i < mesh_.num_owned_nodes(); ++i)
    for (int d = 0; d < dim; ++d) table[dim * mesh_.node_ids()[i] + d] = x(i, d);
  table = merge(mesh_, table);
  Positions result(num_nodes(), Point{});
  for (int i = 0; i < num_nodes(); ++i) std::copy_n(&table[dim * static_cast<std::size_t>(i)], dim, result[i].begin());
  return result;
}

void WholeMesh::scatter(const Positions& from, const CoordinateView& to) const {
  for (int i = 0; i < mesh_.num_nodes(); ++i)
    for (int d = 0; d < dimension(); ++d) to(i, d) = from[mesh_.node_ids()[i]][d];
}

std::vector<double> WholeMesh::gather(const Space& space, int field, const ConstNodalView& values) const {
  const int components = space.field(field).components;
  std::vector<double> table(static_cast<std::size_t>(components) * num_nodes(), 0.0);
  for (int i = 0; i < mesh_.num_owned_nodes(); ++i) {
    const int dof = space.node_dof(field)(i);
    for (int c = 0; dof >= 0 && c < components; ++c) table[components * mesh_.node_ids()[i] + c] = values(dof + c);
  }
  return merge(mesh_, table);
}

void WholeMesh::scatter(const Space& space, int field, const std::vector<double>& from, const NodalView& to) const {
  const int components = space.field(field).components;
  for (int i = 0; i < mesh_.num_nodes(); ++i) {
    const int dof = space.node_dof(field)(i);
    for (int c = 0; dof >= 0 && c < components; ++c) to(dof + c) = from[components * mesh_.node_ids()[i] + c];
  }
}

std::vector<double> WholeMesh::gather_points(int block, int points, const ConstPointView& rows) const {
  const std::size_t columns = rows.extent(1);
  std::vector<double> table(block_elements_[block].size() * points * columns, 0.0);
  const ElementBlock& here = mesh_.blocks()[block];
  for (int e = 0; e < here.num_elements; ++e)
    for (int q = 0; q < points; ++q)
      for (std::size_t c = 0; c < columns; ++c)
        table[(first_row(static_cast<int>(here.global_ids[e]), points) + q) * columns + c] = rows(e * points + q, c);
  return merge(mesh_, table);
}

}  // namespace mudline
