#include "simulation/output/checkpoint_file.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include "core/errors.hpp"
#include "simulation/tests/output_fixture.hpp"

namespace mudline {
namespace {

using output_test::Folder;
using output_test::message_of;
using output_test::world;

const MeshSignature mesh{9, 4, 9, 9, 4, 77};

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
  CheckpointWriter(world(), mesh).write(folder / "c.h5", data);
  const CheckpointData back = CheckpointReader(world(), mesh).read(folder / "c.h5");
  ASSERT_EQ(back.arrays.size(), data.arrays.size());
  for (const auto& [name, array] : data.arrays) {
    ASSERT_EQ(back.arrays.at(name).size(), array.size()) << name;
    EXPECT_TRUE(array.empty() ||
                std::memcmp(back.arrays.at(name).data(), array.data(), array.size() * sizeof(double)) == 0);
  }
  EXPECT_EQ(back.integers, data.integers);
  EXPECT_EQ(back.scalars, data.scalars);
  EXPECT_EQ(back.texts, data.texts);
}

TEST(CheckpointFile, ReplacesTheOldOneAndLeavesNoTemporary) {
  Folder folder;
  CheckpointData data = example();
  const CheckpointWriter writer(world(), mesh);
  writer.write(folder / "c.h5", data);
  data.scalars["time"] = 2.0;
  writer.write(folder / "c.h5", data);
  EXPECT_EQ(CheckpointReader(world(), mesh).read(folder / "c.h5").scalars.at("time"), 2.0);
  EXPECT_FALSE(std::filesystem::exists(folder / "c.h5.part"));
  EXPECT_THROW(writer.write(folder / "missing/c.h5", data), std::runtime_error);
}

TEST(CheckpointFile, SaysWhyItCannotBeUsed) {
  Folder folder;
  const std::string path = folder / "c.h5";
  CheckpointWriter(world(), mesh).write(path, example());
  const auto refusal = [&](const MeshSignature& other, const std::string& file) {
    return message_of<InputError>([&] { CheckpointReader(world(), other).read(file); });
  };
  EXPECT_EQ(refusal(mesh, folder / "none.h5"), (folder / "none.h5") + ": there is no such checkpoint");
  MeshSignature finer = mesh;
  finer.global_nodes = 25;
  finer.global_elements = 16;
  EXPECT_EQ(refusal(finer, path), path +
                                      ": checkpoint belongs to a mesh of 9 nodes and 4 elements, but this mesh has 25 "
                                      "nodes and 16 elements");
  MeshSignature renumbered = mesh;
  renumbered.numbering = 78;
  EXPECT_NE(refusal(renumbered, path).find("numbered or partitioned differently"), std::string::npos);
  std::ofstream(folder / "text.h5") << "no HDF5 at all";
  EXPECT_NE(refusal(mesh, folder / "text.h5").find("cannot be read"), std::string::npos);

  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t version = H5Aopen(file, "format version", H5P_DEFAULT);
  const long long future = 99;
  H5Awrite(version, H5T_NATIVE_LLONG, &future);
  H5Aclose(version);
  H5Fclose(file);
  EXPECT_EQ(refusal(mesh, path), path + ": format version 99, but this program reads version 1");
}

TEST(CheckpointFile, TakesItsSignatureFromTheMesh) {
  const Mesh small(world(), Geometry::plane_strain, output_test::two_shapes(2));
  const MeshSignature signature = signature_of(small);
  EXPECT_EQ(signature.global_nodes, 35);
  EXPECT_EQ(signature.owned_nodes, 35);
  EXPECT_EQ(signature.local_elements, 8);
  EXPECT_EQ(signature_of(small).numbering, signature.numbering);
  EXPECT_NE(signature_of(Mesh(world(), Geometry::plane_strain, output_test::two_shapes(3))).numbering,
            signature.numbering);
}

}  // namespace
}  // namespace mudline
