#include "simulation/output/checkpoint_file.hpp"

#include "core/errors.hpp"
#include "simulation/tests/output_fixture.hpp"

namespace mudline {
namespace {

using output_test::Folder;
using output_test::world;

TEST(CheckpointFile, EachRankGetsItsOwnBack) {
  Folder folder;
  const auto comm = world();
  const int rank = comm->getRank();
  const MeshSignature mesh{9, 4, 6 + rank, 5, 2, 10 + rank, 7, 8};
  CheckpointData data;
  data.arrays["stress"] = rank == 0 ? std::vector<double>{1, 2, 3} : std::vector<double>{4, 5};
  data.arrays["one side only"] = rank == 0 ? std::vector<double>{} : std::vector<double>{6};
  data.integers["active"] = {rank, -rank};
  data.scalars["time"] = 0.25;
  data.texts["stage"] = "push";
  write_checkpoint(*comm, folder / "c.h5", mesh, data);
  const CheckpointData back = read_checkpoint(*comm, folder / "c.h5", mesh);
  EXPECT_EQ(back.arrays, data.arrays);
  EXPECT_EQ(back.integers, data.integers);
  EXPECT_EQ(back.scalars, data.scalars);
  EXPECT_EQ(back.texts, data.texts);

  // Both ranks get everything when one of them has another partition.
  MeshSignature other = mesh;
  if (rank == 1) other.owned_nodes = 6;
  const CheckpointData all = read_checkpoint(*comm, folder / "c.h5", other);
  EXPECT_EQ(all.ranks, 2);
  EXPECT_EQ(all.arrays.at("stress"), (std::vector<double>{1, 2, 3, 4, 5}));
  EXPECT_EQ(all.integers.at("active"), (std::vector<long long>{0, 0, 1, -1}));
}

TEST(CheckpointFile, IsReadOnAnotherNumberOfRanks) {
  Folder folder;
  const auto comm = world();
  const MeshSignature mesh{9, 4, 9, 9, 4, 77, 7, 8};
  CheckpointData data;
  data.arrays["stress"] = {1, 2, 3};
  const auto alone = Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF));
  if (comm->getRank() == 0) write_checkpoint(*alone, folder / "one.h5", mesh, data);
  comm->barrier();
  const CheckpointData back = read_checkpoint(*comm, folder / "one.h5", mesh);
  EXPECT_EQ(back.ranks, 1);
  EXPECT_EQ(back.arrays, data.arrays);
}

TEST(CheckpointFile, RefusesNamesThatDifferBetweenRanks) {
  Folder folder;
  const auto comm = world();
  CheckpointData data;
  data.arrays[comm->getRank() == 0 ? "a" : "b"] = {1.0};
  EXPECT_THROW(write_checkpoint(*comm, folder / "c.h5", {}, data), std::logic_error);
}

}  // namespace
}  // namespace mudline
