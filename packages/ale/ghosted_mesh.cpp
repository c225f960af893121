#include "ale/ghosted_mesh.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <unordered_set>

#include "algebra/raw_communicator.hpp"
#include "algebra/tpetra_compat.hpp"
#include "discretisation/mesh_topology.hpp"
#include "geometry/box_tree.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

using Ids = std::vector<long long>;

Ids flattened(const std::vector<Ids>& lists, std::vector<int>& counts, std::vector<int>& offsets) {
  Ids flat;
  for (std::size_t r = 0; r < lists.size(); ++r) {
    counts[r] = static_cast<int>(lists[r].size());
    offsets[r] = static_cast<int>(flat.size());
    flat.insert(flat.end(), lists[r].begin(), lists[r].end());
  }
  return flat;
}

/// All-to-all exchange: from (rank) the lists for each rank, returns (rank) the lists from each rank.
std::vector<Ids> exchanged(const Comm& comm, const std::vector<Ids>& to) {
  const MPI_Comm mpi = raw_communicator(comm);
  const std::size_t ranks = to.size();
  std::vector<int> counts(ranks), offsets(ranks), from_counts(ranks), from_offsets(ranks);
  const Ids sent = flattened(to, counts, offsets);
  MPI_Alltoall(counts.data(), 1, MPI_INT, from_counts.data(), 1, MPI_INT, mpi);
  int total = 0;
  for (std::size_t r = 0; r < ranks; ++r) {
    from_offsets[r] = total;
    total += from_counts[r];
  }
  Ids received(total);
  MPI_Alltoallv(sent.data(), counts.data(), offsets.data(), MPI_LONG_LONG, received.data(), from_counts.data(),
                from_offsets.data(), MPI_LONG_LONG, mpi);
  std::vector<Ids> result;
  for (std::size_t r = 0; r < ranks; ++r)
    result.emplace_back(received.begin() + from_offsets[r], received.begin() + from_offsets[r] + from_counts[r]);
  return result;
}

void sort_unique(Ids& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

int place_of_id(const Ids& sorted, long long id) {
  return static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), id) - sorted.begin());
}

/// Elements by global id: shape and block, then global nodes.
class Records {
 public:
  void add(long long id, int block, CellShape shape, const long long* nodes) {
    if (!place_.emplace(id, numbers_.size()).second) return;
    numbers_.insert(numbers_.end(), {id, block, static_cast<long long>(shape)});
    numbers_.insert(numbers_.end(), nodes, nodes + mudline::num_nodes(shape));
  }
  /// Adds the records of another table.
  void add(const Ids& numbers) {
    for (std::size_t i = 0; i < numbers.size();) {
      const auto shape = static_cast<CellShape>(numbers[i + 2]);
      add(numbers[i], static_cast<int>(numbers[i + 1]), shape, &numbers[i + 3]);
      i += 3 + mudline::num_nodes(shape);
    }
  }
  bool has(long long id) const { return place_.count(id) > 0; }
  const long long* at(long long id) const { return &numbers_[place_.at(id)]; }
  static int length(const long long* record) { return 3 + mudline::num_nodes(static_cast<CellShape>(record[2])); }
  Ids ids() const {
    Ids result;
    for (const auto& [id, place] : place_) result.push_back(id);
    std::sort(result.begin(), result.end());
    return result;
  }
  const Ids& numbers() const { return numbers_; }

 private:
  std::unordered_map<long long, std::size_t> place_;
  Ids numbers_;
};

Records own_records(const Mesh& mesh) {
  Records result;
  Ids nodes;
  for (std::size_t b = 0; b < mesh.blocks().size(); ++b) {
    const ElementBlock& block = mesh.blocks()[b];
    for (int e = 0; e < block.num_elements; ++e) {
      nodes.clear();
      for (int a = 0; a < mudline::num_nodes(block.shape); ++a) nodes.push_back(mesh.node_ids()[block.nodes(e, a)]);
      result.add(block.global_ids[e], static_cast<int>(b), block.shape, nodes.data());
    }
  }
  return result;
}

/// Finds the elements around this rank's own ones. Owners of nodes know all elements around them.
class Neighbourhood {
 public:
  explicit Neighbourhood(const Mesh& mesh) : records(own_records(mesh)), mesh_(mesh) {}
  Records records;  // of this rank's elements and those found

  void add_layers(int layers) {
    if (mesh_.comm()->getSize() == 1) {
      for (const long long* node : nodes()) asked_.insert(*node);
      return;
    }
    if (layers == GhostedMesh::whole) {
      records.add(all_gather(*mesh_.comm(), Ids(records.numbers())));
      for (const long long* node : nodes()) asked_.insert(*node);
      return;
    }
    find_owners();
    for (int layer = 0; layer < layers; ++layer) add_layer();
  }
  void add_near(const GhostedMesh::Wanted& wanted) {
    const Comm& comm = *mesh_.comm();
    if (comm.getSize() == 1) return;
    std::vector<double> numbers;
    for (const Bounds& box : wanted.boxes) {
      numbers.push_back(comm.getRank());
      numbers.insert(numbers.end(), box.low.begin(), box.low.end());
      numbers.insert(numbers.end(), box.high.begin(), box.high.end());
    }
    numbers = all_gather(comm, numbers);
    std::vector<Bounds> boxes;
    std::vector<int> rank_of;
    for (const double* n = numbers.data(); n < numbers.data() + numbers.size(); n += 7) {
      rank_of.push_back(static_cast<int>(n[0]));
      boxes.push_back({{n[1], n[2], n[3]}, {n[4], n[5], n[6]}});
    }
    const BoxTree tree(std::move(boxes));
    std::vector<Ids> to(comm.getSize());
    std::vector<char> asks(comm.getSize());
    for (const ElementBlock& block : mesh_.blocks())
      for (int e = 0; e < block.num_elements; ++e) {
        Bounds box = Bounds::nothing();
        for (int a = 0; a < mudline::num_nodes(block.shape); ++a) {
          Point place{};
          for (int d = 0; d < mesh_.dimension(); ++d) place[d] = wanted.x(block.nodes(e, a), d);
          box.enclose(place);
        }
        const Point across = box.high - box.low;
        const double reach = dot(across, across);  // squared radius: twice the radius of the box, as elements may bulge
        std::fill(asks.begin(), asks.end(), 0);
        tree.search(box.low + 0.5 * across, reach, [&](int i) { asks[rank_of[i]] = 1; });
        const long long* record = records.at(block.global_ids[e]);
        for (std::size_t rank = 0; rank < to.size(); ++rank)
          if (asks[rank] != 0) to[rank].insert(to[rank].end(), record, record + Records::length(record));
      }
    for (const Ids& from : exchanged(comm, to)) records.add(from);
  }
  bool is_complete(long long node) const { return asked_.count(node) > 0; }
  /// The nodes of all elements, with repetitions.
  std::vector<const long long*> nodes() const {
    std::vector<const long long*> result;
    const Ids& all = records.numbers();
    for (std::size_t i = 0; i < all.size(); i += Records::length(&all[i]))
      for (int a = 3; a < Records::length(&all[i]); ++a) result.push_back(&all[i + a]);
    return result;
  }

 private:
  /// Tells the owners of nodes which elements are around these.
  void find_owners() {
    const Ids& all = records.numbers();
    owned_ = make_map({mesh_.node_ids().begin(), mesh_.node_ids().begin() + mesh_.num_owned_nodes()}, mesh_.comm());
    look_up(nodes());
    std::vector<Ids> to(mesh_.comm()->getSize());
    for (std::size_t i = 0; i < all.size(); i += Records::length(&all[i])) {
      std::set<int> ranks;
      for (int a = 3; a < Records::length(&all[i]); ++a) ranks.insert(owner_.at(all[i + a]));
      for (int rank : ranks) to[rank].insert(to[rank].end(), &all[i], &all[i] + Records::length(&all[i]));
    }
    for (const Ids& from : exchanged(*mesh_.comm(), to)) visitors_.add(from);
    const Ids& known = visitors_.numbers();
    for (std::size_t i = 0; i < known.size(); i += Records::length(&known[i]))
      for (int a = 3; a < Records::length(&known[i]); ++a) around_[known[i + a]].push_back(known[i]);
  }
  void look_up(const std::vector<const long long*>& nodes) {
    std::vector<GlobalOrdinal> ids;
    for (const long long* node : nodes)
      if (owner_.count(*node) == 0) ids.push_back(*node);
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    std::vector<int> ranks(ids.size());
    owned_->getRemoteIndexList(Teuchos::ArrayView<const GlobalOrdinal>(ids.data(), ids.size()),
                               Teuchos::ArrayView<int>(ranks.data(), ranks.size()));
    for (std::size_t i = 0; i < ids.size(); ++i) owner_[ids[i]] = ranks[i];
  }
  void add_layer() {
    const Comm& comm = *mesh_.comm();
    const auto held = nodes();
    look_up(held);
    std::vector<Ids> questions(comm.getSize());
    for (const long long* node : held)
      if (asked_.insert(*node).second) questions[owner_.at(*node)].push_back(*node);
    std::vector<Ids> answers(comm.getSize());
    const std::vector<Ids> asked = exchanged(comm, questions);
    for (std::size_t r = 0; r < asked.size(); ++r) {
      Records answer;
      for (long long node : asked[r])
        for (long long id : around_.at(node)) {
          const long long* record = visitors_.at(id);
          answer.add(id, static_cast<int>(record[1]), static_cast<CellShape>(record[2]), record + 3);
        }
      answers[r] = answer.numbers();
    }
    for (const Ids& from : exchanged(comm, answers)) records.add(from);
  }

  const Mesh& mesh_;
  RCP<const Map> owned_;
  Records visitors_;                           // elements around the nodes that this rank owns
  std::unordered_map<long long, Ids> around_;  // elements around each node
  std::unordered_map<long long, int> owner_;   // rank
  std::unordered_set<long long> asked_;
};

}  // namespace

GhostedMesh::Exchange GhostedMesh::exchange(const std::vector<long long>& own,
                                            const std::vector<long long>& all) const {
  if (mesh_.comm()->getSize() == 1) return {};
  const RCP<const Map> from = make_map({own.begin(), own.end()}, mesh_.comm());
  return {from, rcp(new Import(from, make_map({all.begin(), all.end()}, mesh_.comm())))};
}

GhostedMesh::GhostedMesh(const Mesh& mesh, int layers, const Wanted* near) : mesh_(mesh), layers_(layers) {
  Neighbourhood around(mesh);
  around.add_layers(layers);
  if (near != nullptr) around.add_near(*near);
  const Ids element_ids = around.records.ids();

  // elements, with global nodes at first
  std::unordered_map<SideKey, ElementSide, SideKeyHash> open;
  std::vector<Ids> global_nodes;
  block_elements_.resize(mesh.blocks().size());
  for (long long id : element_ids) {
    const long long* record = around.records.at(id);
    Element element{static_cast<CellShape>(record[2]), static_cast<int>(record[1]), {}, {}};
    element.neighbours.fill(unknown);
    const int e = static_cast<int>(elements_.size());
    global_nodes.emplace_back(record + 3, record + Records::length(record));
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
  own_elements_.resize(mesh.blocks().size());
  own_places_.resize(mesh.blocks().size());
  for (std::size_t b = 0; b < mesh.blocks().size(); ++b)
    for (long long id : mesh.blocks()[b].global_ids) {
      own_elements_[b].push_back(place_of_id(element_ids, id));
      own_places_[b].push_back(place_in_block_[own_elements_[b].back()]);
    }

  // boundaries of regions, from every rank
  std::vector<std::string> names;
  std::map<std::pair<int, int>, Ids> sets;
  for (const auto& [name, sides] : mesh.side_sets()) {
    for (const Side& side : sides)
      sets[{own_elements_[side.block][side.element], side.side}].push_back(static_cast<long long>(names.size()));
    names.push_back(name);
  }
  Ids boundary;
  for (const auto& own : own_elements_)
    for (int e : own)
      for (int s = 0; s < num_sides(elements_[e].shape); ++s) {
        const int other = elements_[e].neighbours[s];
        if (other >= 0 && elements_[other].block == elements_[e].block) continue;
        const std::vector<int>& local = side_nodes(elements_[e].shape, s);
        const Ids& of = sets[{e, s}];
        boundary.insert(boundary.end(), {element_ids[e], s, elements_[e].block, other < 0 ? -1 : elements_[other].block,
                                         other < 0 || other > e, static_cast<long long>(local.size()),
                                         static_cast<long long>(of.size())});
        for (int k : local) boundary.push_back(global_nodes[e][k]);
        boundary.insert(boundary.end(), of.begin(), of.end());
      }
  boundary = all_gather(*mesh.comm(), boundary);
  std::map<std::pair<long long, long long>, std::size_t> sides;  // in the order of elements
  constexpr int head = 7;
  for (std::size_t i = 0; i < boundary.size(); i += head + boundary[i + 5] + boundary[i + 6])
    sides[{boundary[i], boundary[i + 1]}] = i;

  // nodes
  for (const Ids& nodes : global_nodes) node_ids_.insert(node_ids_.end(), nodes.begin(), nodes.end());
  node_ids_.insert(node_ids_.end(), mesh.node_ids().begin(), mesh.node_ids().end());
  for (const auto& [place, i] : sides)
    node_ids_.insert(node_ids_.end(), &boundary[i] + head, &boundary[i] + head + boundary[i + 5]);
  std::map<std::string, Ids> of_sets;
  for (const auto& [name, nodes] : mesh.node_sets()) {
    Ids& ids = of_sets[name];
    for (int node : nodes)
      if (node < mesh.num_owned_nodes()) ids.push_back(mesh.node_ids()[node]);
    ids = all_gather(*mesh.comm(), ids);
    sort_unique(ids);
    node_ids_.insert(node_ids_.end(), ids.begin(), ids.end());
  }
  sort_unique(node_ids_);
  for (long long id : mesh.node_ids()) of_mesh_.push_back(local_node(id));
  owned_.assign(node_ids_.size(), 0);
  for (int i = 0; i < mesh.num_owned_nodes(); ++i) owned_nodes_.push_back(of_mesh_[i]);
  std::sort(owned_nodes_.begin(), owned_nodes_.end());
  Ids own_nodes;
  for (int node : owned_nodes_) {
    owned_[node] = 1;
    own_nodes.push_back(node_ids_[node]);
  }
  element_of_.assign(node_ids_.size(), -1);
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (std::size_t a = 0; a < global_nodes[e].size(); ++a) {
      const int node = local_node(global_nodes[e][a]);
      elements_[e].nodes[a] = node;
      if (element_of_[node] < 0) element_of_[node] = static_cast<int>(e);
    }
  for (long long id : node_ids_) complete_.push_back(around.is_complete(id));
  for (const auto& [name, ids] : of_sets) {
    std::vector<int>& to = node_sets_[name];
    for (long long id : ids) to.push_back(local_node(id));
  }
  on_boundary_.assign(node_ids_.size(), 0);
  for (const auto& [place, i] : sides) {
    const int block = static_cast<int>(boundary[i + 2]), other = static_cast<int>(boundary[i + 3]),
              number = static_cast<int>(boundary[i + 1]);
    BoundarySide side{side_shape(mesh.blocks()[block].shape, number), block, other, {}, {}, boundary[i + 4] != 0};
    const long long* at = &boundary[i] + head;
    for (int k = 0; k < boundary[i + 5]; ++k) side.nodes.push_back(local_node(*at++));
    for (int k = 0; k < boundary[i + 6]; ++k) side.sets.insert(names[*at++]);
    for (int node : side.nodes) on_boundary_[node] = 1;
    boundary_.push_back(std::move(side));
  }

  // maps from owned to all nodes and elements
  nodes_ = exchange(own_nodes, node_ids_);
  for (std::size_t b = 0; b < block_elements_.size(); ++b) {
    Ids own, all;
    for (int e : own_elements_[b]) own.push_back(element_ids[e]);
    for (int e : block_elements_[b]) all.push_back(element_ids[e]);
    points_.push_back(exchange(own, all));
  }
  std::vector<double> vertex(node_ids_.size(), 0.0);
  for (int i = 0; i < mesh.num_owned_nodes(); ++i) vertex[of_mesh_[i]] = mesh.is_vertex()[i];
  fill(vertex, 1);
  vertex_.assign(vertex.begin(), vertex.end());
  for (const std::string& name : names) {
    std::vector<ElementSide>& to = side_sets_[name];
    for (std::size_t b = 0; b < block_elements_.size(); ++b) {
      constexpr int most = 6;  // sides of a cell
      std::vector<double> flags(block_elements_[b].size() * most, 0.0);
      for (const Side& side : mesh.side_sets().at(name))
        if (side.block == static_cast<int>(b)) flags[own_places_[b][side.element] * most + side.side] = 1;
      fill_points(static_cast<int>(b), 1, most, flags);
      for (std::size_t i = 0; i < flags.size(); ++i)
        if (flags[i] != 0) to.push_back({block_elements_[b][i / most], static_cast<int>(i % most)});
    }
    std::sort(to.begin(), to.end(), [](const ElementSide& one, const ElementSide& two) {
      return std::pair(one.element, one.side) < std::pair(two.element, two.side);
    });
  }
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

double GhostedMesh::largest(double mine) const {
  double all = mine;
  Teuchos::reduceAll(*mesh_.comm(), Teuchos::REDUCE_MAX, 1, &mine, &all);
  return all;
}

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
