#pragma once

#include <mpi.h>

#include <vector>

namespace mudline {

/// Sorts values that are distributed over the ranks by their global ids, so that what is written does not depend on the
/// partition. Each rank receives one contiguous slab of ids: files are then written in long pieces, and no rank ever
/// holds the whole field.
class IdOrder {
 public:
  /// Exactly one rank must give each id from 0 to global_count - 1; otherwise std::logic_error on every rank.
  /// Collective.
  IdOrder(MPI_Comm comm, const std::vector<long long>& ids, long long global_count);

  long long global_count() const { return global_count_; }
  /// Number of ids that this rank gave.
  std::size_t local_count() const { return send_order_.size(); }
  /// This rank's slab of ids: first() .. first() + count() - 1.
  long long first() const { return first_; }
  long long count() const { return static_cast<long long>(receive_position_.size()); }

  /// `values`: (own id, component) in the order given at construction; returns (id of the slab, component). Collective.
  template <class T>
  std::vector<T> gather(const std::vector<T>& values, int components) const {
    std::vector<T> packed(send_order_.size() * components), received(receive_position_.size() * components);
    for (std::size_t i = 0; i < send_order_.size(); ++i)
      for (int c = 0; c < components; ++c) packed[i * components + c] = values[send_order_[i] * components + c];
    exchange(packed.data(), received.data(), components * sizeof(T));
    std::vector<T> result(received.size());
    for (std::size_t i = 0; i < receive_position_.size(); ++i)
      for (int c = 0; c < components; ++c) result[receive_position_[i] * components + c] = received[i * components + c];
    return result;
  }

 private:
  void exchange(const void* send, void* receive, std::size_t bytes_per_item) const;

  MPI_Comm comm_;
  long long global_count_, first_ = 0;
  std::vector<int> send_counts_, send_offsets_, receive_counts_, receive_offsets_;  // by rank
  std::vector<std::size_t> send_order_, receive_position_;
};

}  // namespace mudline
