#include "ale/neighbourhood.hpp"

#include <set>

#include "algebra/raw_communicator.hpp"
#include "algebra/tpetra_compat.hpp"
#include "geometry/box_tree.hpp"

namespace mudline {

namespace {

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

ElementRecords own_records(const Mesh& mesh) {
  ElementRecords result;
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

}  // namespace

Neighbourhood::Neighbourhood(const Mesh& mesh) : records(own_records(mesh)), mesh_(mesh) {}

void Neighbourhood::add_layers(int layers) {
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

void Neighbourhood::add_near(const GhostedMesh::Wanted& wanted) {
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
        if (asks[rank] != 0) to[rank].insert(to[rank].end(), record, record + ElementRecords::length(record));
    }
  for (const Ids& from : exchanged(comm, to)) records.add(from);
}

std::vector<const long long*> Neighbourhood::nodes() const {
  std::vector<const long long*> result;
  const Ids& all = records.numbers();
  for (std::size_t i = 0; i < all.size(); i += ElementRecords::length(&all[i]))
    for (int a = 3; a < ElementRecords::length(&all[i]); ++a) result.push_back(&all[i + a]);
  return result;
}

void Neighbourhood::find_owners() {
  const Ids& all = records.numbers();
  owned_ = make_map({mesh_.node_ids().begin(), mesh_.node_ids().begin() + mesh_.num_owned_nodes()}, mesh_.comm());
  look_up(nodes());
  std::vector<Ids> to(mesh_.comm()->getSize());
  for (std::size_t i = 0; i < all.size(); i += ElementRecords::length(&all[i])) {
    std::set<int> ranks;
    for (int a = 3; a < ElementRecords::length(&all[i]); ++a) ranks.insert(owner_.at(all[i + a]));
    for (int rank : ranks) to[rank].insert(to[rank].end(), &all[i], &all[i] + ElementRecords::length(&all[i]));
  }
  for (const Ids& from : exchanged(*mesh_.comm(), to)) visitors_.add(from);
  const Ids& known = visitors_.numbers();
  for (std::size_t i = 0; i < known.size(); i += ElementRecords::length(&known[i]))
    for (int a = 3; a < ElementRecords::length(&known[i]); ++a) around_[known[i + a]].push_back(known[i]);
}

void Neighbourhood::look_up(const std::vector<const long long*>& nodes) {
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

void Neighbourhood::add_layer() {
  const Comm& comm = *mesh_.comm();
  const auto held = nodes();
  look_up(held);
  std::vector<Ids> questions(comm.getSize());
  for (const long long* node : held)
    if (asked_.insert(*node).second) questions[owner_.at(*node)].push_back(*node);
  std::vector<Ids> answers(comm.getSize());
  const std::vector<Ids> asked = exchanged(comm, questions);
  for (std::size_t r = 0; r < asked.size(); ++r) {
    ElementRecords answer;
    for (long long node : asked[r])
      for (long long id : around_.at(node)) {
        const long long* record = visitors_.at(id);
        answer.add(id, static_cast<int>(record[1]), static_cast<CellShape>(record[2]), record + 3);
      }
    answers[r] = answer.numbers();
  }
  for (const Ids& from : exchanged(comm, answers)) records.add(from);
}

}  // namespace mudline
