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

/// Makes an HDF5 file without content under this name, with room for so many bytes, on this process alone. HDF5 leaves
/// the first `user_block` bytes alone. Returns what went wrong, or "".
std::string make_empty(const std::string& path, long long bytes, std::size_t user_block) {
  std::string begin(user_block, '\0');
  try {
    begin += h5::file_image([](hid_t) {});
  } catch (const std::runtime_error& failure) {
    return failure.what();
  }
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_TRUNC, 0666);
  if (file < 0) return "cannot create '" + path + "': " + std::strerror(errno);
  int error = posix_fallocate(file, 0, bytes + static_cast<long long>(begin.size()));
  const auto written = error == 0 ? ::write(file, begin.data(), begin.size()) : 0;
  if (error == 0 && written != static_cast<ssize_t>(begin.size())) error = written < 0 ? errno : ENOSPC;
  close(file);
  return error == 0 ? "" : "cannot write '" + path + "': " + std::strerror(error);
}

std::string write(MPI_Comm comm, const std::string& path, const FileSize& size, std::size_t user_block,
                  const std::function<void(hid_t file)>& content, const Seal& seal) {
  constexpr long long around = 16384, by_object = 2048;  // [bytes] upper estimates of HDF5's own data
  const std::string temporary = path + ".part";
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const auto here = static_cast<long long>(size.bytes);
  long long bytes = 0;
  MPI_Allreduce(&here, &bytes, 1, MPI_LONG_LONG, MPI_SUM, comm);
  bytes += around + by_object * static_cast<long long>(size.objects);
  std::string error = agreed_message(comm, rank == 0 ? make_empty(temporary, bytes, user_block) : "");
  std::error_code ignored;
  if (!error.empty()) {
    if (rank == 0) std::filesystem::remove(temporary, ignored);
    return error;
  }
  try {
    // HDF5 would empty a file that it creates, and its room could be lost. An opened file is cut to its length at the
    // end.
    const auto file = h5::open_file(comm, temporary, true);
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
