#include "simulation/output/field_file.hpp"

#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "simulation/tests/output_fixture.hpp"

namespace mudline {
namespace {

using namespace output_test;

struct Result {
  explicit Result(int columns = 2) : mesh(world(), Geometry::axisymmetric, two_shapes(columns)) {}
  void write(FieldFile& file, double time, double factor = 1.0) const {
    auto place = owned_coordinates(mesh);
    for (double& x : place) x *= 1 + time;
    file.write(time, static_cast<int>(10 * time), "push & <hold>", place,
               {{"pore pressure", "Pa", 1, by_node(mesh, 1, [&](long long id, int) { return factor * id; })},
                {"displacement", "m", 2, by_node(mesh, 2, [&](long long id, int c) { return id + 0.5 * c; })}},
               {{"effective stress", "Pa", 6, by_element(mesh, 6, [&](long long id, int c) { return 10 * id + c; })},
                {"void ratio", "-", 1, by_element(mesh, 1, [&](long long id, int) { return 0.1 * id; })}},
               {{"cone", {0.0, -time}}});
  }
  Mesh mesh;
};
const BodyOutline contour{{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}};
const BodyOutline tetrahedron{{{0, 0, 1}, {2, 0, 1}, {0, 2, 1}, {0, 0, 2}},
                              {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};

void write_in_space(const Mesh& mesh, FieldFile& file, const BodyPose& pose) {
  file.write(0, 0, "push", owned_coordinates(mesh), {}, {}, {{"a spike", pose}});
}

TEST(FieldFile, WritesTheMeshOnceInGlobalOrder) {
  Folder folder;
  Result result;
  FieldFile(result.mesh, folder / "r").set_metadata("program", "mudline");
  EXPECT_FALSE(std::filesystem::exists(folder / "r.xdmf"));  // nothing to see yet
  const auto topology = dataset(folder / "r.h5", "/mesh/topology");
  ASSERT_EQ(topology.size(), 4u * 10 + 4 * 7);
  EXPECT_EQ(std::vector<double>(topology.begin(), topology.begin() + 10),
            (std::vector<double>{35, 0, 2, 16, 14, 1, 9, 15, 7, 8}));
  EXPECT_EQ(std::vector<double>(topology.begin() + 40, topology.begin() + 47),
            (std::vector<double>{36, 4, 6, 20, 5, 13, 12}));
  EXPECT_EQ(dataset(folder / "r.h5", "/mesh/offset"), (std::vector<double>{0, 10, 20, 30, 40, 47, 54, 61}));
  EXPECT_EQ(dataset(folder / "r.h5", "/mesh/region"), (std::vector<double>{0, 0, 0, 0, 1, 1, 1, 1}));
  const auto coordinates = dataset(folder / "r.h5", "/mesh/coordinates");
  ASSERT_EQ(coordinates.size(), 35u * 3);
  EXPECT_EQ(coordinates[3 * 8], 0.5);
  EXPECT_EQ(coordinates[3 * 8 + 1], 0.5);
  EXPECT_EQ(coordinates[3 * 8 + 2], 0.0);
}

TEST(FieldFile, StepsAreCompleteOnDiskWhileTheFileIsOpen) {
  Folder folder;
  Result result;
  FieldFile file(result.mesh, folder / "r");
  file.add_body("cone", contour);
  file.set_metadata("deck", "old");
  file.set_metadata("deck", std::string(80000, 'd'));
  for (int step = 0; step < 3; ++step) {
    result.write(file, 0.5 * step);
    const std::string name = "00000" + std::to_string(step), group = "/steps/" + name, copy = folder / "r.h5";
    EXPECT_EQ(dataset(copy, group + "/nodal/pore_pressure")[34], 34.0);
    const auto displacement = dataset(copy, group + "/nodal/displacement");
    EXPECT_EQ(std::vector<double>(displacement.begin() + 6, displacement.begin() + 9),
              (std::vector<double>{2, 2.5, 0}));
    const auto stress = dataset(copy, group + "/cell/effective_stress");
    ASSERT_EQ(stress.size(), 8u * 6);
    // xx yy zz yz xz xy = 0..5 becomes xx xy xz yy yz zz.
    EXPECT_EQ(std::vector<double>(stress.begin() + 6, stress.begin() + 12),
              (std::vector<double>{10, 15, 14, 11, 13, 12}));
    EXPECT_EQ(dataset(copy, group + "/coordinates")[3 * 8], 0.5 * (1 + 0.5 * step));
    EXPECT_EQ(dataset(copy, group + "/bodies/cone/coordinates")[4], 1 - 0.5 * step);
    const std::string xdmf = content(folder / "r.xdmf");
    EXPECT_NE(xdmf.find("r.fields/" + name + ".h5:/cell/effective_stress</DataItem>"), std::string::npos);
    EXPECT_NE(xdmf.find("<Attribute Name=\"pore pressure [Pa]\" AttributeType=\"Scalar\" Center=\"Node\">"),
              std::string::npos);
    EXPECT_NE(xdmf.find("Value=\"push &amp; &lt;hold&gt;\""), std::string::npos);
    EXPECT_EQ(xdmf.substr(xdmf.size() - 8), "</Xdmf>\n");
    EXPECT_EQ(file.num_steps(), step + 1);
  }
}

TEST(FieldFile, RestartDropsLaterStepsAndGoesOn) {
  Folder folder;
  Result result;
  const auto run = [&](const std::string& stem, std::optional<FieldRestart> restart, int first, int last,
                       double factor) {
    FieldFile file(result.mesh, stem, restart);
    file.add_body("cone", contour);
    for (int step = first; step <= last; ++step) result.write(file, step, factor);
  };
  run(folder / "whole", {}, 0, 4, 1.0);
  run(folder / "parts", {}, 0, 2, 1.0);
  {
    FieldFile wrong_future(result.mesh, folder / "parts", FieldRestart{3});
    result.write(wrong_future, 3, 99.0);
  }
  run(folder / "parts", FieldRestart{3}, 3, 4, 1.0);
  std::string parts = content(folder / "parts.xdmf");
  for (std::size_t at = 0; (at = parts.find("parts.fields", at)) != std::string::npos;) parts.replace(at, 5, "whole");
  EXPECT_EQ(parts, content(folder / "whole.xdmf"));
  for (const char* name :
       {"/steps/000001/nodal/pore_pressure", "/steps/000003/nodal/pore_pressure", "/steps/000004/coordinates"})
    EXPECT_EQ(dataset(folder / "parts.h5", name), dataset(folder / "whole.h5", name)) << name;
  EXPECT_TRUE(dataset(folder / "parts.h5", "/steps/000005/coordinates").empty());
  EXPECT_FALSE(std::filesystem::exists(folder / "parts.fields/000005.h5"));

  FieldFile from_the_start(result.mesh, folder / "parts", FieldRestart{});
  EXPECT_EQ(from_the_start.num_steps(), 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "parts.xdmf"));
}

TEST(FieldFile, ContourInThePlaneTurnsAboutZ) {
  Folder folder;
  Result result;
  FieldFile file(result.mesh, folder / "r");
  file.add_body("cone", contour);
  const BodyPose pose{{0.5, 0.25, 0}, {{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}}, {0, 1, 0}};
  file.write(0, 0, "push", owned_coordinates(result.mesh), {}, {}, {{"cone", pose}});
  EXPECT_EQ(dataset(folder / "r.h5", "/bodies/cone/contour"), (std::vector<double>{0, 0, 1, 1, 0, 1}));
  EXPECT_EQ(dataset(folder / "r.h5", "/steps/000000/bodies/cone/coordinates"),
            (std::vector<double>{1.5, 1.25, 0, 0.5, 2.25, 0, 0.5, 1.25, 0}));
  EXPECT_EQ(attribute(folder / "r.fields/000000.h5", "/bodies/cone", "displacement"), (std::vector<double>{0.5, 0.25}));
  EXPECT_EQ(attribute(folder / "r.fields/000000.h5", "/bodies/cone", "rotation"), std::vector<double>{std::acos(0.0)});
}

TEST(FieldFile, BodyInSpaceIsASurfaceThatTurnsAboutAnyAxis) {
  Folder folder;
  const Mesh mesh(world(), Geometry::space, cube());
  FieldFile file(mesh, folder / "r");
  file.add_body("a spike", tetrahedron);
  // a rotation about the axis (1, 1, 1): x becomes y, y becomes z, z becomes x
  const BodyPose pose{{0.5, 0, -0.25}, {{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}}, {0, 0, 1}};
  write_in_space(mesh, file, pose);
  EXPECT_EQ(dataset(folder / "r.h5", "/bodies/a_spike/surface"),
            (std::vector<double>{0, 0, 1, 2, 0, 1, 0, 2, 1, 0, 0, 2}));
  EXPECT_EQ(dataset(folder / "r.h5", "/bodies/a_spike/triangles"),
            (std::vector<double>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}));
  EXPECT_EQ(dataset(folder / "r.h5", "/steps/000000/bodies/a_spike/coordinates"),
            (std::vector<double>{0.5, 0, 0.75, 0.5, 2, 0.75, 0.5, 0, 2.75, 1.5, 0, 0.75}));
  const std::string step = folder / "r.fields/000000.h5";
  EXPECT_EQ(attribute(step, "/bodies/a_spike", "displacement"), (std::vector<double>{0.5, 0, -0.25}));
  EXPECT_EQ(attribute(step, "/bodies/a_spike", "rotation"), (std::vector<double>{0, 0, 1, 1, 0, 0, 0, 1, 0}));
  const std::string xdmf = content(folder / "r.xdmf");
  EXPECT_NE(xdmf.find("<Grid Name=\"a spike\" GridType=\"Uniform\">\n        <Topology TopologyType=\"Triangle\" "
                      "NumberOfElements=\"4\"><DataItem Dimensions=\"4 3\" NumberType=\"Int\" Precision=\"4\" "
                      "Format=\"HDF\">r.h5:/bodies/a_spike/triangles</DataItem></Topology>"),
            std::string::npos);
  EXPECT_NE(xdmf.find("r.fields/000000.h5:/bodies/a_spike/coordinates"), std::string::npos);
}

TEST(FieldFile, BodyInSpaceThatDoesNotTurnKeepsEveryBit) {
  Folder folder;
  const Mesh mesh(world(), Geometry::space, cube());
  FieldFile file(mesh, folder / "r");
  BodyOutline spike = tetrahedron;
  spike.points[0] = {0.1, 0.2, 1.3};
  file.add_body("a spike", spike);
  BodyPose pose;
  pose.shift = {0.01, 0.02, -0.03};
  pose.centre = {7.7, 8.8, 9.9};
  write_in_space(mesh, file, pose);
  const auto points = dataset(folder / "r.h5", "/steps/000000/bodies/a_spike/coordinates");
  EXPECT_EQ(std::vector<double>(points.begin(), points.begin() + 3),
            (std::vector<double>{0.1 + 0.01, 0.2 + 0.02, 1.3 - 0.03}));
}

TEST(FieldFile, RestartRefusesAnotherOutline) {
  Folder folder;
  const Result plane;
  const Mesh space(world(), Geometry::space, cube());
  {
    FieldFile in_plane(plane.mesh, folder / "plane"), in_space(space, folder / "space");
    in_plane.add_body("cone", contour);
    plane.write(in_plane, 0);
    in_space.add_body("a spike", tetrahedron);
    write_in_space(space, in_space, {});
  }
  FieldFile in_plane(plane.mesh, folder / "plane", FieldRestart{1}), in_space(space, folder / "space", FieldRestart{1});
  BodyOutline longer = contour, turned = tetrahedron;
  longer.points.push_back({0, 0.5, 0});
  std::swap(turned.facets[0], turned.facets[1]);
  EXPECT_EQ(message_of<InputError>([&] { in_plane.add_body("cone", longer); }),
            (folder / "plane.h5") + ": body 'cone' has another contour than in the first run");
  EXPECT_EQ(message_of<InputError>([&] { in_space.add_body("a spike", turned); }),
            (folder / "space.h5") + ": body 'a spike' has another surface than in the first run");
  in_space.add_body("a spike", tetrahedron);
  write_in_space(space, in_space, {});
  EXPECT_EQ(in_space.num_steps(), 2);
  EXPECT_THROW(in_plane.add_body("spike", tetrahedron), std::invalid_argument);
  EXPECT_THROW(in_space.add_body("cone", contour), std::invalid_argument);
}

TEST(FieldFile, AStepThatWasCutShortHarmsNothing) {
  Folder folder;
  Result result;
  {
    FieldFile file(result.mesh, folder / "r");
    file.add_body("cone", contour);
    for (int step = 0; step < 2; ++step) result.write(file, step);
  }
  // A killed run may leave half a step, a step that the index does not have yet, or half an index.
  std::ofstream(folder / "r.fields/000002.h5.part") << "half a step";
  std::filesystem::copy_file(folder / "r.fields/000001.h5", folder / "r.fields/000002.h5");
  std::ofstream(folder / "r.h5.part") << "half an index";
  FieldFile file(result.mesh, folder / "r", FieldRestart{2});
  file.add_body("cone", contour);
  EXPECT_EQ(file.num_steps(), 2);
  EXPECT_TRUE(dataset(folder / "r.h5", "/steps/000002/coordinates").empty());
  result.write(file, 2, 7.0);
  EXPECT_EQ(dataset(folder / "r.h5", "/steps/000002/nodal/pore_pressure")[34], 7.0 * 34);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / ""))
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
}

TEST(FieldFile, RestartNeedsTheStepsThatTheIndexNames) {
  Folder folder;
  Result result;
  {
    FieldFile file(result.mesh, folder / "r");
    file.add_body("cone", contour);
    result.write(file, 0);
  }
  std::filesystem::remove(folder / "r.fields/000000.h5");
  EXPECT_NE(message_of<InputError>([&] {
              FieldFile(result.mesh, folder / "r", FieldRestart{1});
            }).find((folder / "r.fields/000000.h5") + ": the file is missing"),
            std::string::npos);
}

TEST(FieldFile, RefusesToGoOnWithStepsLost) {
  Folder folder;
  Result result;
  {
    FieldFile file(result.mesh, folder / "r");
    file.add_body("cone", contour);
    for (int step = 0; step < 2; ++step) result.write(file, step);
  }
  const auto refusal = [&](const std::string& stem) {
    return message_of<InputError>([&] { FieldFile(result.mesh, stem, FieldRestart{3, 5.0}); });
  };
  EXPECT_NE(refusal(folder / "r").find("only 2 of the 3 outputs up to the checkpoint are left"), std::string::npos);
  EXPECT_NE(refusal(folder / "none").find("the file is missing"), std::string::npos);
  EXPECT_EQ(FieldFile(result.mesh, folder / "r", FieldRestart{3, 0.5, true}).num_steps(), 1);
  EXPECT_EQ(FieldFile(result.mesh, folder / "none", FieldRestart{3, 0.5, true}).num_steps(), 0);
}

TEST(FieldFile, KnowsWhoseResultsThereAre) {
  Folder folder;
  Result result;
  EXPECT_FALSE(metadata_of(folder / "r").has_value());
  FieldFile file(result.mesh, folder / "r");
  file.set_metadata("deck file", "a.xml");
  file.add_body("cone", contour);
  EXPECT_FALSE(metadata_of(folder / "r").has_value());  // nothing to lose yet
  result.write(file, 0);
  EXPECT_EQ(metadata_of(folder / "r").value().at("deck_file"), "a.xml");
  std::ofstream(folder / "text.h5") << "no HDF5 at all";
  EXPECT_TRUE(metadata_of(folder / "text").value().empty());
}

TEST(FieldFile, RestartRefusesAnotherMeshOrAForeignFile) {
  Folder folder;
  FieldFile(Result(2).mesh, folder / "r");
  const Result finer(3);
  EXPECT_NE(message_of<InputError>([&] {
              FieldFile(finer.mesh, folder / "r", FieldRestart{1});
            }).find("belongs to a mesh of 35 nodes and 8 elements, but this mesh has 45 and 10"),
            std::string::npos);
  std::ofstream(folder / "text.h5") << "no HDF5 at all";
  EXPECT_NE(
      message_of<InputError>([&] { FieldFile(finer.mesh, folder / "text", FieldRestart{1}); }).find("cannot be opened"),
      std::string::npos);
}

TEST(FieldFile, NeverWritesWhatIsNotFinite) {
  Folder folder;
  Result result;
  FieldFile file(result.mesh, folder / "r");
  const auto place = owned_coordinates(result.mesh);
  auto values = by_node(result.mesh, 1, [](long long id, int) { return double(id); });
  values[7] = std::numeric_limits<double>::quiet_NaN();
  const std::string message = message_of<std::runtime_error>([&] {
    file.write(0, 0, "push", place, {{"pore pressure", "Pa", 1, values}}, {});
  });
  EXPECT_EQ(message,
            (folder / "r.h5") + ": field 'pore pressure' holds a value that is not finite (nan); nothing was written");
  EXPECT_EQ(file.num_steps(), 0);
  values[7] = 0;
  file.write(0, 0, "push", place, {{"pore pressure", "Pa", 1, values}}, {});  // the file is still usable
  EXPECT_EQ(file.num_steps(), 1);
}

TEST(FieldFile, RefusesWrongCalls) {
  Folder folder;
  Result result;
  FieldFile file(result.mesh, folder / "r");
  const auto place = owned_coordinates(result.mesh);
  const auto refusal = [&](const std::vector<OutputField>& nodal) {
    return message_of<std::invalid_argument>([&] { file.write(0, 0, "push", place, nodal, {}); });
  };
  const std::vector<double> one(35, 1.0);
  EXPECT_EQ(refusal({{"p", "Pa", 4, one}}), "field 'p' has 4 components; allowed: 1, 2, 3, 6");
  EXPECT_EQ(refusal({{"p", "Pa", 2, one}}), "field 'p' has 35 values on a rank that has 35 rows of 2");
  EXPECT_EQ(refusal({{"p q", "Pa", 1, one}, {"p/q", "Pa", 1, one}}), "two fields are called 'p/q'");
  EXPECT_THROW(result.write(file, 0.0), std::invalid_argument);  // the cone was never added
}

}  // namespace
}  // namespace mudline
