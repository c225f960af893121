#pragma once

#include <mpi.h>
#include <Teuchos_DefaultMpiComm.hpp>

namespace mudline {

/// The MPI communicator behind `comm` (MPI_COMM_SELF for a serial one). Not a copy: do not free it.
inline MPI_Comm raw_communicator(const Teuchos::Comm<int>& comm) {
  const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(&comm);
  return mpi != nullptr ? (*mpi->getRawMpiComm())() : MPI_COMM_SELF;
}

}  // namespace mudline
