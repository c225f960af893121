// The file that all ranks write together: its room on the disk, and what is left of it.
#include "simulation/output/whole_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>

#include "output_fixture.hpp"

namespace mudline {
namespace {

using output_test::Folder;

std::size_t size_of(const std::string& path) { return std::filesystem::file_size(path); }

TEST(WholeFile, RoomIsKeptWhileTheFileIsWritten) {
  const Folder folder;
  const std::string path = folder / "a.h5";
  const std::size_t half = 500000;  // [bytes]
  std::size_t room = 0;
  const std::string error = write_whole_and_seal(MPI_COMM_WORLD, path, {half, 1}, "checkpoint", 1,
                                                 [&](hid_t) { room = size_of(path + ".part"); });
  EXPECT_EQ(error, "");
  EXPECT_GE(room, 2 * half);
  EXPECT_LT(size_of(path), 10000u);
}

TEST(WholeFile, RanksWriteTheirRows) {
  const Folder folder;
  const std::string path = folder / "a.h5";
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const hsize_t count = 1000;
  std::vector<long long> mine(count);
  std::iota(mine.begin(), mine.end(), static_cast<long long>(rank * count));
  const auto write = [&](hid_t file) { h5::write(file, "rows", mine, {2 * count, 0, rank * count, count}); };
  ASSERT_EQ(write_whole(MPI_COMM_WORLD, path, {count * sizeof(long long), 1}, write), "");
  std::vector<long long> all(2 * count);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(h5::read_all<long long>(h5::open_file(MPI_COMM_WORLD, path, false), "rows"), all);
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

}  // namespace
}  // namespace mudline
