#include "simulation/output/collective.hpp"

#include <vector>

#include "core/run_error.hpp"

namespace mudline {

namespace {

std::string broadcast_from(MPI_Comm comm, const std::string& text, int root) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  int size = static_cast<int>(text.size());
  MPI_Bcast(&size, 1, MPI_INT, root, comm);
  std::string result = rank == root ? text : std::string(size, '\0');
  MPI_Bcast(result.data(), size, MPI_CHAR, root, comm);
  return result;
}

}  // namespace

std::string agreed_message(MPI_Comm comm, const std::string& message) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  const int mine = message.empty() ? ranks : rank;
  int first = ranks;
  MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, comm);
  return first == ranks ? "" : broadcast_from(comm, message, first);
}

void end_where_lost(MPI_Comm comm, const std::string& lost) {
  const std::string agreed = agreed_message(comm, lost);
  if (!agreed.empty()) throw RunError(agreed);
}

std::string broadcast(MPI_Comm comm, const std::string& text) { return broadcast_from(comm, text, 0); }

bool same_everywhere(MPI_Comm comm, const std::string& text) {
  const std::uint64_t hash = fingerprint(text.data(), text.size());
  // The maximum of the complement is the complement of the minimum: one reduction finds both.
  const std::uint64_t mine[2] = {hash, ~hash};
  std::uint64_t highest[2];
  MPI_Allreduce(mine, highest, 2, MPI_UINT64_T, MPI_MAX, comm);
  return highest[0] == ~highest[1];
}

std::uint64_t fingerprint(const void* data, std::size_t bytes, std::uint64_t start) {
  const auto* byte = static_cast<const unsigned char*>(data);
  std::uint64_t hash = start;
  for (std::size_t i = 0; i < bytes; ++i) hash = (hash ^ byte[i]) * 1099511628211ull;
  return hash;
}

}  // namespace mudline
