#include "simulation/output/whole_file.hpp"

#include <filesystem>
#include <stdexcept>

#include "simulation/output/atomic_file.hpp"
#include "simulation/output/collective.hpp"

namespace mudline {

std::string write_whole(MPI_Comm comm, const std::string& path, const std::function<void(hid_t file)>& content) {
  const std::string temporary = path + ".part";
  std::string error;
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  try {
    const auto file = h5::create_file(comm, temporary);
    content(file);
    h5::flush(file, temporary);
  } catch (const std::runtime_error& failure) {
    error = std::string(failure.what()) + " (disk full?)";
  }
  error = agreed_message(comm, error);
  if (error.empty()) return agreed_message(comm, rank == 0 ? rename_file(temporary, path) : "");
  std::error_code ignored;
  if (rank == 0) std::filesystem::remove(temporary, ignored);
  return error;
}

}  // namespace mudline
