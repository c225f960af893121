#include "ale/ghosted_mesh.hpp"

#include <algorithm>
#include <iterator>
#include <unordered_map>

#include "ale/neighbourhood.hpp"
#include "algebra/over_ranks.hpp"
#include "algebra/raw_communicator.hpp"
#include "algebra/tpetra_compat.hpp"
#include "discretisation/mesh_topology.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

int place_of_id(const Ids& sorted, long long id) {
  return static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), id) - sorted.begin());
}

/// A side on the boundary of a region as numbers: element, number in it, block, block across, whether it is the first
/// of two, the counts of its nodes and of its sets, then these by global number.
struct SideRecord {
  const long long* at;
  int number() const { return static_cast<int>(at[1]); }
  int block() const { return static_cast<int>(at[2]); }
  int other() const { return static_cast<int>(at[3]); }
  bool first() const { return at[4] != 0; }
  const long long* nodes() const { return at + 7; }
  const long long* sets() const { return nodes() + at[5]; }
  const long long* end() const { return sets() + at[6]; }
  std::ptrdiff_t length() const { return end() - at; }
};

}  // namespace

GhostedMesh::Exchange GhostedMesh::exchange(const std::vector<long long>& own,
                                            const std::vector<long long>& all) const {
  if (mesh_.comm()->getSize() == 1) return {};
  const RCP<const Map> from = make_map({own.begin(), own.end()}, mesh_.comm());
  return {from, rcp(new Import(from, make_map({all.begin(), all.end()}, mesh_.comm())))};
}

/// The mesh by global numbers, while its local ones are found.
struct GhostedMesh::Numbers {
  Ids elements;                          // ascending
  std::vector<Ids> nodes;                // by element
  std::vector<std::string> side_sets;    // names
  std::map<std::string, Ids> node_sets;  // of the whole mesh, ascending
  Ids boundary;                          // sides of all ranks, see SideRecord
  std::vector<const long long*> sides;   // these in the order of elements
};

GhostedMesh::GhostedMesh(const Mesh& mesh, int layers, const Wanted* near) : mesh_(mesh), layers_(layers) {
  Neighbourhood around(mesh);
  around.add_layers(layers);
  if (near != nullptr) around.add_near(*near);
  Numbers numbers;
  numbers.elements = around.records.ids();
  add_elements(around, numbers);
  find_own_elements(numbers);
  gather_boundary(numbers);
  gather_node_sets(numbers);
  number_nodes(numbers);
  for (long long id : node_ids_) complete_.push_back(around.is_complete(id));
  add_boundary(numbers);
  make_exchanges(numbers);
  std::vector<double> vertex(node_ids_.size(), 0.0);
  for (int i = 0; i < mesh.num_owned_nodes(); ++i) vertex[of_mesh_[i]] = mesh.is_vertex()[i];
  fill(vertex, 1);
  vertex_.assign(vertex.begin(), vertex.end());
  for (const std::string& name : numbers.side_sets) add_side_set(name);
}

void GhostedMesh::add_elements(const Neighbourhood& around, Numbers& numbers) {
  std::unordered_map<SideKey, ElementSide, SideKeyHash> open;
  block_elements_.resize(mesh_.blocks().size());
  for (long long id : numbers.elements) {
    const long long* record = around.records.at(id);
    Element element{static_cast<CellShape>(record[2]), static_cast<int>(record[1]), {}, {}};
    element.neighbours.fill(unknown);
    const int e = static_cast<int>(elements_.size());
    numbers.nodes.emplace_back(record + 3, record + ElementRecords::length(record));
    elements_.push_back(element);
    for (int s = 0; s < num_sides(element.shape); ++s) {
      const std::vector<int>& local = side_nodes(element.shape, s);
      long long corners[4];
      const int count = num_corners(side_shape(element.shape, s));
      for (int k = 0; k < count; ++k) corners[k] = record[3 + local[k]];
      const SideKey key = sorted_key(corners, count);
      const auto found = open.find(key);
      if (found == open.end()) {
        open[key] = {e, s};
        // A side that has a complete corner is on the boundary unless a neighbour is found later.
        for (int k = 0; k < count; ++k)
          if (around.is_complete(corners[k])) elements_[e].neighbours[s] = outside;
        continue;
      }
      elements_[e].neighbours[s] = found->second.element;
      elements_[found->second.element].neighbours[found->second.side] = e;
      open.erase(found);
    }
    place_in_block_.push_back(static_cast<int>(block_elements_[element.block].size()));
    block_elements_[element.block].push_back(e);
  }
}

void GhostedMesh::find_own_elements(const Numbers& numbers) {
  own_elements_.resize(mesh_.blocks().size());
  own_places_.resize(mesh_.blocks().size());
  for (std::size_t b = 0; b < mesh_.blocks().size(); ++b)
    for (long long id : mesh_.blocks()[b].global_ids) {
      own_elements_[b].push_back(place_of_id(numbers.elements, id));
      own_places_[b].push_back(place_in_block_[own_elements_[b].back()]);
    }
}

void GhostedMesh::gather_boundary(Numbers& numbers) const {
  std::map<std::pair<int, int>, Ids> sets;
  for (const auto& [name, sides] : mesh_.side_sets()) {
    for (const Side& side : sides)
      sets[{own_elements_[side.block][side.element], side.side}].push_back(
          static_cast<long long>(numbers.side_sets.size()));
    numbers.side_sets.push_back(name);
  }
  Ids& boundary = numbers.boundary;
  for (const auto& own : own_elements_)
    for (int e : own)
      for (int s = 0; s < num_sides(elements_[e].shape); ++s) {
        const int other = elements_[e].neighbours[s];
        if (other >= 0 && elements_[other].block == elements_[e].block) continue;
        const std::vector<int>& local = side_nodes(elements_[e].shape, s);
        const Ids& of = sets[{e, s}];
        boundary.insert(boundary.end(), {numbers.elements[e], s, elements_[e].block,
                                         other < 0 ? -1 : elements_[other].block, other < 0 || other > e,
                                         static_cast<long long>(local.size()), static_cast<long long>(of.size())});
        for (int k : local) boundary.push_back(numbers.nodes[e][k]);
        boundary.insert(boundary.end(), of.begin(), of.end());
      }
  boundary = all_gather(*mesh_.comm(), boundary);
  for (std::size_t i = 0; i < boundary.size(); i += SideRecord{&boundary[i]}.length())
    numbers.sides.push_back(&boundary[i]);
  std::sort(numbers.sides.begin(), numbers.sides.end(), [](const long long* one, const long long* two) {
    return std::pair(one[0], one[1]) < std::pair(two[0], two[1]);
  });
}

void GhostedMesh::gather_node_sets(Numbers& numbers) const {
  for (const auto& [name, nodes] : mesh_.node_sets()) {
    Ids& ids = numbers.node_sets[name];
    for (int node : nodes)
      if (node < mesh_.num_owned_nodes()) ids.push_back(mesh_.node_ids()[node]);
    ids = all_gather(*mesh_.comm(), ids);
    sort_unique(ids);
  }
}

void GhostedMesh::number_nodes(const Numbers& numbers) {
  const auto add = [&](const Ids& ids) { node_ids_.insert(node_ids_.end(), ids.begin(), ids.end()); };
  for (const Ids& nodes : numbers.nodes) add(nodes);
  node_ids_.insert(node_ids_.end(), mesh_.node_ids().begin(), mesh_.node_ids().end());
  for (const long long* numbers_of : numbers.sides) {
    const SideRecord side{numbers_of};
    node_ids_.insert(node_ids_.end(), side.nodes(), side.sets());
  }
  for (const auto& [name, ids] : numbers.node_sets) add(ids);
  sort_unique(node_ids_);
  for (long long id : mesh_.node_ids()) of_mesh_.push_back(local_node(id));
  owned_.assign(node_ids_.size(), 0);
  owned_nodes_.assign(of_mesh_.begin(), of_mesh_.begin() + mesh_.num_owned_nodes());
  std::sort(owned_nodes_.begin(), owned_nodes_.end());
  for (int node : owned_nodes_) owned_[node] = 1;
  element_of_.assign(node_ids_.size(), -1);
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (std::size_t a = 0; a < numbers.nodes[e].size(); ++a) {
      const int node = local_node(numbers.nodes[e][a]);
      elements_[e].nodes[a] = node;
      if (element_of_[node] < 0) element_of_[node] = static_cast<int>(e);
    }
  for (const auto& [name, ids] : numbers.node_sets) {
    std::vector<int>& to = node_sets_[name];
    for (long long id : ids) to.push_back(local_node(id));
  }
}

void GhostedMesh::add_boundary(const Numbers& numbers) {
  on_boundary_.assign(node_ids_.size(), 0);
  for (const long long* numbers_of : numbers.sides) {
    const SideRecord record{numbers_of};
    const CellShape shape = side_shape(mesh_.blocks()[record.block()].shape, record.number());
    BoundarySide side{shape, record.block(), record.other(), {}, {}, record.first()};
    for (const long long* id = record.nodes(); id != record.sets(); ++id) side.nodes.push_back(local_node(*id));
    for (const long long* set = record.sets(); set != record.end(); ++set) side.sets.insert(numbers.side_sets[*set]);
    for (int node : side.nodes) on_boundary_[node] = 1;
    boundary_.push_back(std::move(side));
  }
}

void GhostedMesh::make_exchanges(const Numbers& numbers) {
  Ids own_nodes;
  for (int node : owned_nodes_) own_nodes.push_back(node_ids_[node]);
  nodes_ = exchange(own_nodes, node_ids_);
  for (std::size_t b = 0; b < block_elements_.size(); ++b) {
    Ids own, all;
    for (int e : own_elements_[b]) own.push_back(numbers.elements[e]);
    for (int e : block_elements_[b]) all.push_back(numbers.elements[e]);
    points_.push_back(exchange(own, all));
  }
}

void GhostedMesh::add_side_set(const std::string& name) {
  std::vector<ElementSide>& to = side_sets_[name];
  for (std::size_t b = 0; b < block_elements_.size(); ++b) {
    constexpr int most = 6;  // sides of a cell
    std::vector<double> flags(block_elements_[b].size() * most, 0.0);
    for (const Side& side : mesh_.side_sets().at(name))
      if (side.block == static_cast<int>(b)) flags[own_places_[b][side.element] * most + side.side] = 1;
    fill_points(static_cast<int>(b), 1, most, flags);
    for (std::size_t i = 0; i < flags.size(); ++i)
      if (flags[i] != 0) to.push_back({block_elements_[b][i / most], static_cast<int>(i % most)});
  }
  std::sort(to.begin(), to.end(), [](const ElementSide& one, const ElementSide& two) {
    return std::pair(one.element, one.side) < std::pair(two.element, two.side);
  });
}

int GhostedMesh::local_node(long long id) const { return place_of_id(node_ids_, id); }

void GhostedMesh::fill(const Exchange& exchange, const std::vector<int>& own, int width, double* values) const {
  if (exchange.import.is_null() || width == 0) return;
  MultiVector from(exchange.from, width, false), to(exchange.import->getTargetMap(), width, false);
  {
    const auto view = from.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0; i < own.size(); ++i)
      for (int c = 0; c < width; ++c) view(i, c) = values[static_cast<std::size_t>(own[i]) * width + c];
  }
  to.doImport(from, *exchange.import, Tpetra::INSERT);
  const auto view = to.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t i = 0; i < view.extent(0); ++i)
    for (int c = 0; c < width; ++c) values[i * width + c] = view(i, c);
}

void GhostedMesh::fill(std::vector<double>& values, int components) const {
  fill(nodes_, owned_nodes_, components, values.data());
}

void GhostedMesh::fill(Positions& x) const { fill(nodes_, owned_nodes_, place_size, x.data()->data()); }

void GhostedMesh::fill_points(int block, int points, int columns, std::vector<double>& table) const {
  fill(points_[block], own_places_[block], points * columns, table.data());
}

double GhostedMesh::sum(long double mine) const {
  long double all = mine;
  MPI_Allreduce(&mine, &all, 1, MPI_LONG_DOUBLE, MPI_SUM, raw_communicator(*mesh_.comm()));
  return static_cast<double>(all);
}

double GhostedMesh::largest(double mine) const { return max_over_ranks(*mesh_.comm(), mine); }

Positions GhostedMesh::gather(const ConstCoordinateView& x) const {
  Positions result(num_nodes(), Point{});
  for (int i = 0; i < mesh_.num_owned_nodes(); ++i)
    for (int d = 0; d < dimension(); ++d) result[of_mesh_[i]][d] = x(i, d);
  fill(result);
  return result;
}

void GhostedMesh::scatter(const Positions& from, const CoordinateView& to) const {
  for (int i = 0; i < mesh_.num_nodes(); ++i)
    for (int d = 0; d < dimension(); ++d) to(i, d) = from[of_mesh_[i]][d];
}

std::vector<double> GhostedMesh::gather_nodes(const std::vector<double>& values, int components) const {
  std::vector<double> table(static_cast<std::size_t>(components) * num_nodes(), 0.0);
  for (int i = 0; i < mesh_.num_owned_nodes(); ++i)
    std::copy_n(&values[static_cast<std::size_t>(components) * i], components,
                &table[static_cast<std::size_t>(components) * of_mesh_[i]]);
  fill(table, components);
  return table;
}

std::vector<double> GhostedMesh::gather(const Space& space, int field, const ConstNodalView& values) const {
  const int components = space.field(field).components;
  std::vector<double> table(static_cast<std::size_t>(components) * num_nodes(), 0.0);
  for (int i = 0; i < mesh_.num_owned_nodes(); ++i) {
    const int dof = space.node_dof(field)(i);
    if (dof >= 0)
      for (int c = 0; c < components; ++c) table[components * of_mesh_[i] + c] = values(dof + c);
  }
  fill(table, components);
  return table;
}

void GhostedMesh::scatter(const Space& space, int field, const std::vector<double>& from, const NodalView& to) const {
  const int components = space.field(field).components;
  for (int i = 0; i < mesh_.num_nodes(); ++i) {
    const int dof = space.node_dof(field)(i);
    if (dof >= 0)
      for (int c = 0; c < components; ++c) to(dof + c) = from[components * of_mesh_[i] + c];
  }
}

std::vector<double> GhostedMesh::gather_points(int block, int points, const ConstPointView& rows) const {
  const std::size_t columns = rows.extent(1);
  std::vector<double> table(block_elements_[block].size() * points * columns, 0.0);
  for (std::size_t e = 0; e < own_elements_[block].size(); ++e)
    for (int q = 0; q < points; ++q)
      for (std::size_t c = 0; c < columns; ++c)
        table[(static_cast<std::size_t>(own_places_[block][e]) * points + q) * columns + c] = rows(e * points + q, c);
  fill_points(block, points, static_cast<int>(columns), table);
  return table;
}

}  // namespace mudline
