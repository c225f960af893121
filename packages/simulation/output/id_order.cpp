#include "simulation/output/id_order.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "simulation/output/collective.hpp"

namespace mudline {

namespace {

std::vector<int> offsets_of(const std::vector<int>& counts) {
  std::vector<int> offsets(counts.size(), 0);
  for (std::size_t r = 1; r < counts.size(); ++r) offsets[r] = offsets[r - 1] + counts[r - 1];
  return offsets;
}

}  // namespace

IdOrder::IdOrder(MPI_Comm comm, const std::vector<long long>& ids, long long global_count)
    : comm_(comm), global_count_(global_count) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  const auto slab_start = [&](int r) { return global_count * r / ranks; };
  first_ = slab_start(rank);

  std::string error;
  std::vector<int> destination(ids.size(), 0);
  send_counts_.assign(ranks, 0);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] < 0 || ids[i] >= global_count) {
      error = "global id " + std::to_string(ids[i]) + " is outside 0.." + std::to_string(global_count - 1);
      break;
    }
    int r = static_cast<int>(ids[i] * ranks / global_count);
    while (ids[i] < slab_start(r)) --r;
    while (ids[i] >= slab_start(r + 1)) ++r;
    destination[i] = r;
    ++send_counts_[r];
  }
  error = agreed_message(comm, error);
  if (!error.empty()) throw std::logic_error(error);

  receive_counts_.assign(ranks, 0);
  MPI_Alltoall(send_counts_.data(), 1, MPI_INT, receive_counts_.data(), 1, MPI_INT, comm);
  send_offsets_ = offsets_of(send_counts_);
  receive_offsets_ = offsets_of(receive_counts_);

  send_order_.resize(ids.size());
  std::vector<int> next = send_offsets_;
  for (std::size_t i = 0; i < ids.size(); ++i) send_order_[next[destination[i]]++] = i;

  std::vector<long long> packed(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) packed[i] = ids[send_order_[i]];
  std::vector<long long> received(receive_offsets_.back() + receive_counts_.back());
  exchange(packed.data(), received.data(), sizeof(long long));

  std::vector<char> seen(slab_start(rank + 1) - first_, 0);
  receive_position_.resize(received.size());
  for (std::size_t i = 0; i < received.size(); ++i) {
    receive_position_[i] = received[i] - first_;
    if (seen[receive_position_[i]]++) error = "global id " + std::to_string(received[i]) + " is given twice";
  }
  if (error.empty() && received.size() != seen.size())
    error =
        "global id " + std::to_string(first_ + (std::find(seen.begin(), seen.end(), 0) - seen.begin())) + " is missing";
  error = agreed_message(comm, error);
  if (!error.empty()) throw std::logic_error(error);
}

void IdOrder::exchange(const void* send, void* receive, std::size_t bytes_per_item) const {
  // With a type of the item's size counts and offsets are in items, far below the limit of int.
  MPI_Datatype item;
  MPI_Type_contiguous(static_cast<int>(bytes_per_item), MPI_BYTE, &item);
  MPI_Type_commit(&item);
  MPI_Alltoallv(send, send_counts_.data(), send_offsets_.data(), item, receive, receive_counts_.data(),
                receive_offsets_.data(), item, comm_);
  MPI_Type_free(&item);
}

}  // namespace mudline
