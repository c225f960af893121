#include "discretisation/distribute.hpp"

#include <metis.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <Teuchos_CommHelpers.hpp>

#include "core/errors.hpp"
#include "discretisation/agree.hpp"

namespace mudline {

namespace {

long long count_elements(const GlobalMesh& mesh) {
  long long count = 0;
  for (const auto& block : mesh.blocks) count += static_cast<long long>(block.nodes.size()) / num_nodes(block.shape);
  return count;
}

/// The rank of every element by METIS, which may leave ranks empty.
std::vector<int> metis_partition(const GlobalMesh& mesh, int ranks, long long elements) {
  constexpr int contact_side_weight = 2;  // cost of a side in contact, in elements
  std::vector<idx_t> start{0}, corners, weights;
  std::vector<std::size_t> offsets{0};
  for (const auto& block : mesh.blocks) {
    const int per_element = num_nodes(block.shape);
    for (std::size_t first = 0; first < block.nodes.size(); first += per_element) {
      for (int c = 0; c < num_corners(block.shape); ++c) corners.push_back(static_cast<idx_t>(block.nodes[first + c]));
      start.push_back(static_cast<idx_t>(corners.size()));
      weights.push_back(per_element);
    }
    offsets.push_back(weights.size());
  }
  for (const std::string& name : mesh.contacts.surfaces) {
    const auto found = mesh.side_sets.find(name);
    if (found == mesh.side_sets.end()) continue;
    for (const auto& side : found->second)
      weights[offsets[side.block] + side.element] += contact_side_weight * num_nodes(mesh.blocks[side.block].shape);
  }
  idx_t num_elements = static_cast<idx_t>(elements), num_nodes = static_cast<idx_t>(mesh.coordinates.size());
  idx_t common = 4, parts = ranks, cut = 0;  // `common`: the number of corners that neighbours share
  for (const auto& block : mesh.blocks)
    for (int s = 0; s < mudline::num_sides(block.shape); ++s)
      common = std::min<idx_t>(common, num_corners(side_shape(block.shape, s)));
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  std::vector<idx_t> element_part(elements), node_part(num_nodes);
  const int status =
      METIS_PartMeshDual(&num_elements, &num_nodes, start.data(), corners.data(), weights.data(), nullptr, &common,
                         &parts, nullptr, options, &cut, element_part.data(), node_part.data());
  if (status != METIS_OK) throw std::runtime_error("METIS failed to partition the mesh");
  return {element_part.begin(), element_part.end()};
}

/// Owner of every node. For a node of several ranks, a rule picks one of them: a whole interface between two ranks goes
/// to the same rank, for some interfaces to the lower and for others to the higher rank.
std::vector<int> node_owners(const std::vector<std::vector<long long>>& nodes_of_rank, std::size_t num_nodes) {
  constexpr int none = std::numeric_limits<int>::max();
  std::vector<int> lowest(num_nodes, none), highest(num_nodes, -1);
  for (int rank = 0; rank < static_cast<int>(nodes_of_rank.size()); ++rank)
    for (long long node : nodes_of_rank[rank]) {
      lowest[node] = std::min(lowest[node], rank);
      highest[node] = rank;
    }
  std::map<long long, std::vector<int>> shared;
  for (int rank = 0; rank < static_cast<int>(nodes_of_rank.size()); ++rank)
    for (long long node : nodes_of_rank[rank])
      if (lowest[node] != highest[node]) shared[node].push_back(rank);
  std::vector<int> owners = std::move(lowest);
  for (const auto& [node, ranks] : shared) {
    int sum = 0;
    for (int rank : ranks) sum += rank;
    owners[node] = ranks[sum % ranks.size()];
  }
  return owners;
}

}  // namespace

MeshCutter::MeshCutter(const GlobalMesh& mesh, int ranks)
    : mesh_(mesh),
      offsets_{0},
      rank_of_(partition_elements(mesh, ranks)),
      elements_of_rank_(ranks),
      nodes_of_rank_(ranks) {
  place_.reserve(rank_of_.size());
  for (const auto& block : mesh.blocks) {
    const int n = num_nodes(block.shape);
    std::vector<int> count(ranks, 0);
    for (std::size_t first = 0; first < block.nodes.size(); first += n) {
      const int rank = rank_of_[place_.size()];
      elements_of_rank_[rank].push_back(static_cast<long long>(place_.size()));
      place_.push_back(count[rank]++);
      auto& nodes = nodes_of_rank_[rank];
      nodes.insert(nodes.end(), block.nodes.begin() + first, block.nodes.begin() + first + n);
    }
    offsets_.push_back(static_cast<long long>(place_.size()));
  }
  for (auto& nodes : nodes_of_rank_) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  is_vertex_.assign(mesh.coordinates.size(), 0);
  for (const auto& block : mesh.blocks) {
    const int n = num_nodes(block.shape), corners = num_corners(block.shape);
    for (std::size_t first = 0; first < block.nodes.size(); first += n)
      for (int c = 0; c < corners; ++c) is_vertex_[block.nodes[first + c]] = 1;
  }
  owners_ = node_owners(nodes_of_rank_, mesh.coordinates.size());
  local_.resize(mesh.coordinates.size());
  for (const auto& [name, sides] : mesh.side_sets)
    for (const auto& side : sides) {
      const auto& block = mesh.blocks[side.block];
      for (int node : side_nodes(block.shape, side.side))
        set_nodes_[name].push_back(block.nodes[side.element * num_nodes(block.shape) + node]);
    }
  for (const auto& [name, nodes] : mesh.node_sets) set_nodes_[name] = nodes;
  for (auto& [name, nodes] : set_nodes_) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  add_partners();
  describe_whole();
}

/// Adds missing nodes of a pair's second set as ghosts; their owners stay the same.
void MeshCutter::add_partners() {
  for (const auto& [first, second] : mesh_.contacts.pairs) {
    if (mesh_.side_sets.count(first) == 0 || mesh_.side_sets.count(second) == 0) continue;
    std::vector<char> concerned(nodes_of_rank_.size(), 0);
    for (const auto& side : mesh_.side_sets.at(first)) concerned[rank_of_[offsets_[side.block] + side.element]] = 1;
    const auto& partners = set_nodes_.at(second);
    for (std::size_t rank = 0; rank < concerned.size(); ++rank) {
      if (!concerned[rank]) continue;
      std::vector<long long> all;
      std::set_union(nodes_of_rank_[rank].begin(), nodes_of_rank_[rank].end(), partners.begin(), partners.end(),
                     std::back_inserter(all));
      nodes_of_rank_[rank] = std::move(all);
    }
  }
}

void MeshCutter::describe_whole() {
  whole_.num_global_nodes = static_cast<long long>(mesh_.coordinates.size());
  whole_.num_global_elements = offsets_.back();
  whole_.bounds = Bounds::nothing();
  for (const Point& point : mesh_.coordinates) whole_.bounds.enclose(point);
  for (const auto& block : mesh_.blocks) {
    const auto [region, added] = whole_.region_bounds.emplace(block.region, Bounds::nothing());
    if (added) whole_.regions.push_back(block.region);
    for (long long node : block.nodes) region->second.enclose(mesh_.coordinates[node]);
  }
}

MeshPart MeshCutter::part(int rank) {
  MeshPart part = whole_;
  number_nodes(rank, part);
  add_elements(rank, part);
  add_sets(rank, part);
  return part;
}

void MeshCutter::number_nodes(int rank, MeshPart& part) {
  part.node_ids = nodes_of_rank_[rank];
  const auto ghosts = std::stable_partition(part.node_ids.begin(), part.node_ids.end(),
                                            [&](long long node) { return owners_[node] == rank; });
  part.num_owned_nodes = static_cast<int>(ghosts - part.node_ids.begin());
  for (std::size_t i = 0; i < part.node_ids.size(); ++i) {
    const Point& point = mesh_.coordinates[part.node_ids[i]];
    part.coordinates.insert(part.coordinates.end(), point.begin(), point.begin() + mesh_.dimension());
    part.is_vertex.push_back(is_vertex_[part.node_ids[i]]);
    local_[part.node_ids[i]] = static_cast<int>(i);
  }
}

void MeshCutter::add_elements(int rank, MeshPart& part) const {
  for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
    const auto& block = mesh_.blocks[b];
    const int n = num_nodes(block.shape);
    MeshPart::Block mine{block.region, block.shape, {}, {}};
    const auto& all = elements_of_rank_[rank];
    mine.ids.assign(std::lower_bound(all.begin(), all.end(), offsets_[b]),
                    std::lower_bound(all.begin(), all.end(), offsets_[b + 1]));
    for (long long id : mine.ids)
      for (int a = 0; a < n; ++a) mine.nodes.push_back(local_[block.nodes[(id - offsets_[b]) * n + a]]);
    part.blocks.push_back(std::move(mine));
  }
}

void MeshCutter::add_sets(int rank, MeshPart& part) const {
  for (const auto& [name, sides] : mesh_.side_sets) {
    auto& mine = part.side_sets[name];
    for (const auto& side : sides) {
      const long long id = offsets_[side.block] + side.element;
      if (rank_of_[id] == rank) mine.push_back({side.block, place_[id], side.side});
    }
  }
  for (const auto& [name, nodes] : set_nodes_) part.set_nodes[name] = local(nodes, part);
  for (const auto& [name, nodes] : mesh_.node_sets) part.node_sets[name] = part.set_nodes.at(name);
}

/// Local numbers of the given nodes that the rank being cut has.
std::vector<int> MeshCutter::local(const std::vector<long long>& sorted_nodes, const MeshPart& part) const {
  std::vector<int> mine;
  for (long long node : sorted_nodes) {
    // local_ keeps numbers of ranks cut before: they count only where this rank's list confirms them.
    const auto candidate = static_cast<std::size_t>(local_[node]);
    if (candidate < part.node_ids.size() && part.node_ids[candidate] == node) mine.push_back(local_[node]);
  }
  std::sort(mine.begin(), mine.end());
  return mine;
}

namespace {

/// Calls `piece(first, size)` for consecutive pieces of the bytes, because MPI counts them by int and a part may be
/// larger.
template <class Piece>
void in_pieces(long long bytes, Piece&& piece) {
  constexpr long long largest = 1 << 30;
  for (long long first = 0; first < bytes; first += largest)
    piece(first, static_cast<int>(std::min(largest, bytes - first)));
}

void send_part(const Teuchos::Comm<int>& comm, MeshPart part, int rank) {
  ByteStream stream;
  stream(part);
  const auto size = static_cast<long long>(stream.bytes().size());
  Teuchos::send(comm, size, rank);
  in_pieces(size, [&](long long first, int count) { Teuchos::send(comm, count, stream.bytes().data() + first, rank); });
}

MeshPart receive_part(const Teuchos::Comm<int>& comm) {
  long long size = 0;
  Teuchos::receive(comm, 0, &size);
  std::vector<char> bytes(size);
  in_pieces(size, [&](long long first, int count) { Teuchos::receive(comm, 0, count, bytes.data() + first); });
  ByteStream stream(std::move(bytes));
  MeshPart part;
  stream(part);
  return part;
}

}  // namespace

std::vector<int> partition_elements(const GlobalMesh& mesh, int ranks) {
  const long long elements = count_elements(mesh);
  if (elements < ranks)
    throw InputError("the mesh has " + std::to_string(elements) + " elements, fewer than the " + std::to_string(ranks) +
                     " ranks; use fewer ranks or a finer mesh");
  if (ranks == 1) return std::vector<int>(elements, 0);
  if (elements > std::numeric_limits<idx_t>::max() / 4)
    throw InputError("the mesh has " + std::to_string(elements) + " elements, more than METIS can number");

  std::vector<int> result = metis_partition(mesh, ranks, elements);
  std::vector<char> used(ranks, 0);
  for (int rank : result) used[rank] = 1;
  if (std::count(used.begin(), used.end(), 0) == 0) return result;
  // With few elements per rank METIS may leave a rank empty. Then every rank gets an equal share in the source's order.
  for (long long e = 0; e < elements; ++e) result[e] = static_cast<int>(e * ranks / elements);
  return result;
}

MeshPart distribute(const Teuchos::Comm<int>& comm, const GlobalMesh& mesh) {
  std::unique_ptr<MeshCutter> cutter;
  agree(comm, [&] {
    if (comm.getRank() == 0) cutter = std::make_unique<MeshCutter>(mesh, comm.getSize());
  });
  if (comm.getRank() != 0) return receive_part(comm);
  for (int rank = 1; rank < comm.getSize(); ++rank) send_part(comm, cutter->part(rank), rank);
  return cutter->part(0);
}

}  // namespace mudline
