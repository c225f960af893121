#include "simulation/output/whole_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "simulation/output/atomic_file.hpp"
#include "simulation/output/collective.hpp"
#include "simulation/output/seal.hpp"

namespace mudline {

namespace {

using Seal = std::function<std::string(const std::string& path)>;

/// Reserves room for so many bytes under this name, in a file that is emptied first or as it is, on rank 0. Returns why
/// there is none, or "".
std::string take_room(const std::string& path, long long bytes, bool empty) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (empty ? O_TRUNC : 0), 0666);
  if (file < 0) return "cannot create '" + path + "': " + std::strerror(errno);
  const int error = posix_fallocate(file, 0, bytes);
  close(file);
  return error == 0 ? "" : "cannot write '" + path + "': " + std::strerror(error);
}

std::string write(MPI_Comm comm, const std::string& path, const FileSize& size, hsize_t user_block,
                  const std::function<void(hid_t file)>& content, const Seal& seal) {
  constexpr long long around = 16384, by_object = 2048;  // [bytes] upper estimates of HDF5's own data
  const std::string temporary = path + ".part";
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const auto here = static_cast<long long>(size.bytes);
  long long bytes = 0;
  MPI_Allreduce(&here, &bytes, 1, MPI_LONG_LONG, MPI_SUM, comm);
  bytes += around + by_object * static_cast<long long>(size.objects);
  const auto room = [&](bool empty) {
    return agreed_message(comm, rank == 0 ? take_room(temporary, bytes, empty) : "");
  };
  std::error_code ignored;
  std::string error = room(true);
  if (!error.empty()) {
    if (rank == 0) std::filesystem::remove(temporary, ignored);
    return error;
  }
  try {
    const auto file = h5::create_file(comm, temporary, user_block);
    error = room(false);  // HDF5 has emptied the file, and cuts it to its length at the end
    if (!error.empty()) throw std::runtime_error(error);
    content(file);
    h5::flush(file, temporary);
  } catch (const std::runtime_error& failure) {
    error = failure.what();
  }
  error = agreed_message(comm, error);
  if (error.empty() && seal) error = agreed_message(comm, rank == 0 ? seal(temporary) : "");
  if (error.empty()) return agreed_message(comm, rank == 0 ? rename_file(temporary, path) : "");
  if (rank == 0) std::filesystem::remove(temporary, ignored);
  return error;
}

}  // namespace

std::string write_whole(MPI_Comm comm, const std::string& path, const FileSize& size,
                        const std::function<void(hid_t file)>& content) {
  return write(comm, path, size, 0, content, {});
}

std::string write_whole_and_seal(MPI_Comm comm, const std::string& path, const FileSize& size, const std::string& kind,
                                 int version, const std::function<void(hid_t file)>& content) {
  return write(comm, path, size, seal_size, content,
               [&](const std::string& file) { return write_seal(file, kind, version); });
}

}  // namespace mudline
