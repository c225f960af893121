#include "simulation/output/checkpoint_file.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include "core/errors.hpp"
#include "core/run_error.hpp"
#include "simulation/tests/output_fixture.hpp"

namespace mudline {
namespace {

using output_test::content;
using output_test::Folder;
using output_test::message_of;
using output_test::world;

const MeshSignature mesh{9, 4, 9, 9, 4, 77, 7, 8};

CheckpointData example() {
  CheckpointData data;
  data.arrays["soil/effective stress"] = {1.0 / 3.0, -0.0, 5e-324, std::numeric_limits<double>::infinity(),
                                          std::nan("")};
  data.arrays["100% empty"] = {};
  data.integers["contact/cone/active"] = {0, 1, -2147483647};
  data.scalars["time"] = 0.1 + 0.2;
  data.texts["deck"] = std::string(100000, 'x') + "<Parameter name=\"a\"/>\n";
  data.texts["stage"] = "";
  return data;
}

TEST(CheckpointFile, ReturnsEveryBit) {
  Folder folder;
  const CheckpointData data = example();
  write_checkpoint(*world(), folder / "c.h5", mesh, data);
  const CheckpointData back = read_checkpoint(*world(), folder / "c.h5", mesh);
  ASSERT_EQ(back.arrays.size(), data.arrays.size());
  for (const auto& [name, array] : data.arrays) {
    ASSERT_EQ(back.arrays.at(name).size(), array.size()) << name;
    EXPECT_TRUE(array.empty() ||
                std::memcmp(back.arrays.at(name).data(), array.data(), array.size() * sizeof(double)) == 0);
  }
  EXPECT_EQ(back.integers, data.integers);
  EXPECT_EQ(back.scalars, data.scalars);
  EXPECT_EQ(back.texts, data.texts);
  EXPECT_EQ(back.ranks, 0);
  EXPECT_FALSE(back.moved_nodes);
  EXPECT_EQ(read_checkpoint_texts(*world(), folder / "c.h5"), data.texts);
}

TEST(CheckpointFile, ReplacesTheOldOneAndLeavesNoTemporary) {
  Folder folder;
  CheckpointData data = example();
  write_checkpoint(*world(), folder / "c.h5", mesh, data);
  data.scalars["time"] = 2.0;
  write_checkpoint(*world(), folder / "c.h5", mesh, data);
  EXPECT_EQ(read_checkpoint(*world(), folder / "c.h5", mesh).scalars.at("time"), 2.0);
  EXPECT_FALSE(std::filesystem::exists(folder / "c.h5.part"));
  EXPECT_THROW(write_checkpoint(*world(), folder / "missing/c.h5", mesh, data), RunError);
}

TEST(CheckpointFile, SaysWhyItCannotBeUsed) {
  Folder folder;
  const std::string path = folder / "c.h5";
  write_checkpoint(*world(), path, mesh, example());
  const auto refusal = [&](const MeshSignature& other, const std::string& file) {
    return message_of<InputError>([&] { read_checkpoint(*world(), file, other); });
  };
  EXPECT_EQ(refusal(mesh, folder / "none.h5"), (folder / "none.h5") + ": there is no such checkpoint");
  MeshSignature finer = mesh;
  finer.global_nodes = 25;
  finer.global_elements = 16;
  EXPECT_EQ(refusal(finer, path), path +
                                      ": checkpoint belongs to a mesh of 9 nodes and 4 elements, but this mesh has 25 "
                                      "nodes and 16 elements");
  MeshSignature renumbered = mesh;
  renumbered.topology = 78;
  EXPECT_NE(refusal(renumbered, path).find("nodes are numbered differently"), std::string::npos);
  std::ofstream(folder / "text.h5") << "no HDF5 at all";
  EXPECT_NE(refusal(mesh, folder / "text.h5").find("cut short"), std::string::npos);
  std::ofstream(folder / "long.h5") << std::string(2000, 'x');
  EXPECT_NE(refusal(mesh, folder / "long.h5").find("not a checkpoint of this version"), std::string::npos);
}

TEST(CheckpointFile, AnotherPartitionGetsThePartsOfAllRanks) {
  Folder folder;
  const CheckpointData data = example();
  write_checkpoint(*world(), folder / "c.h5", mesh, data);
  MeshSignature other = mesh;
  other.numbering = 78;
  other.coordinates = 5;
  const CheckpointData back = read_checkpoint(*world(), folder / "c.h5", other);
  EXPECT_EQ(back.ranks, 1);
  EXPECT_TRUE(back.moved_nodes);
  EXPECT_EQ(back.integers, data.integers);
}

TEST(CheckpointFile, EveryFlippedBitIsFound) {
  Folder folder;
  write_checkpoint(*world(), folder / "c.h5", mesh, example());
  const std::string good = content(folder / "c.h5");
  ASSERT_GT(good.size(), 100000u);
  for (std::size_t k = 0; k < 500; ++k) {
    std::string bad = good;
    const std::size_t byte = k < 250 ? k : (k * 7919 * 131) % good.size();
    bad[byte] = static_cast<char>(bad[byte] ^ (1 << k % 8));
    std::ofstream(folder / "bad.h5", std::ios::binary) << bad;
    EXPECT_THROW(read_checkpoint_texts(*world(), folder / "bad.h5"), InputError) << byte;
  }
  std::ofstream(folder / "short.h5", std::ios::binary) << good.substr(0, good.size() - 1);
  EXPECT_NE(message_of<InputError>([&] { read_checkpoint(*world(), folder / "short.h5", mesh); }).find("damaged"),
            std::string::npos);
}

TEST(CheckpointFile, TakesItsSignatureFromTheMesh) {
  const Mesh small(world(), Geometry::plane_strain, output_test::two_shapes(2));
  const MeshSignature signature = signature_of(small);
  EXPECT_EQ(signature.global_nodes, 35);
  EXPECT_EQ(signature.owned_nodes, 35);
  EXPECT_EQ(signature.local_elements, 8);
  EXPECT_EQ(signature_of(small).numbering, signature.numbering);
  const MeshSignature larger = signature_of(Mesh(world(), Geometry::plane_strain, output_test::two_shapes(3)));
  EXPECT_NE(larger.numbering, signature.numbering);
  EXPECT_NE(larger.topology, signature.topology);
  GlobalMesh moved = output_test::two_shapes(2);
  moved.coordinates[1][0] *= 1 + 1e-15;
  const MeshSignature other = signature_of(Mesh(world(), Geometry::plane_strain, moved));
  EXPECT_EQ(other.topology, signature.topology);
  EXPECT_NE(other.coordinates, signature.coordinates);
}

}  // namespace
}  // namespace mudline
