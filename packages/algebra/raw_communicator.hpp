#pragma once

#include <mpi.h>
#include <Teuchos_DefaultMpiComm.hpp>

#include <type_traits>
#include <vector>

namespace mudline {

/// The MPI communicator behind `comm` (MPI_COMM_SELF for a serial one). Not a copy: do not free it.
inline MPI_Comm raw_communicator(const Teuchos::Comm<int>& comm) {
  const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(&comm);
  return mpi != nullptr ? (*mpi->getRawMpiComm())() : MPI_COMM_SELF;
}

/// The numbers of all ranks in rank order, on every rank; `first` gets the index at which this rank's begin. T: double
/// or long long. Collective.
template <class T>
std::vector<T> all_gather(const Teuchos::Comm<int>& comm, const std::vector<T>& mine, std::size_t* first = nullptr) {
  static_assert(std::is_same_v<T, double> || std::is_same_v<T, long long>);
  const MPI_Datatype type = std::is_same_v<T, double> ? MPI_DOUBLE : MPI_LONG_LONG;
  const MPI_Comm mpi = raw_communicator(comm);
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(comm.getSize()), offsets(comm.getSize() + 1, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, mpi);
  for (std::size_t r = 0; r < counts.size(); ++r) offsets[r + 1] = offsets[r] + counts[r];
  std::vector<T> all(offsets.back());
  MPI_Allgatherv(mine.data(), count, type, all.data(), counts.data(), offsets.data(), type, mpi);
  if (first != nullptr) *first = offsets[comm.getRank()];
  return all;
}

}  // namespace mudline
