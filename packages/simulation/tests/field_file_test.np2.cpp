#include "simulation/output/field_file.hpp"

#include <limits>

#include "core/errors.hpp"
#include "simulation/tests/output_fixture.hpp"

namespace mudline {
namespace {

using namespace output_test;

void write_run(const Mesh& mesh, const std::string& stem) {
  FieldFile file(mesh, stem);
  file.add_body("cone", {{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}});
  for (int step = 0; step < 2; ++step)
    file.write(step, step, "push", owned_coordinates(mesh),
               {{"displacement", "m", 2, by_node(mesh, 2, [&](long long id, int c) { return step + id / (3.0 + c); })}},
               {{"void ratio", "-", 1, by_element(mesh, 1, [](long long id, int) { return 1.0 / (1 + id); })}},
               {{"cone", {0.0, -0.1 * step}}});
}

TEST(FieldFile, DoesNotDependOnTheRankCount) {
  Folder folder;
  const auto alone = Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF));
  const Mesh shared(world(), Geometry::plane_strain, world()->getRank() == 0 ? two_shapes(3) : GlobalMesh());
  write_run(shared, folder / "two");
  if (world()->getRank() == 0) {
    write_run(Mesh(alone, Geometry::plane_strain, two_shapes(3)), folder / "one");
    for (const char* name :
         {"/mesh/topology", "/mesh/offset", "/mesh/region", "/mesh/coordinates", "/steps/000001/coordinates",
          "/steps/000000/nodal/displacement", "/steps/000001/nodal/displacement", "/steps/000001/cell/void_ratio",
          "/steps/000001/bodies/cone/coordinates"}) {
      const auto values = dataset(folder / "two.h5", name);
      EXPECT_FALSE(values.empty()) << name;
      EXPECT_EQ(values, dataset(folder / "one.h5", name)) << name;
    }
  }
}

TEST(FieldFile, BadValueOfOneRankIsThrownOnBoth) {
  Folder folder;
  const Mesh mesh(world(), Geometry::plane_strain, world()->getRank() == 0 ? two_shapes(3) : GlobalMesh());
  FieldFile file(mesh, folder / "r");
  auto values = by_node(mesh, 1, [](long long id, int) { return double(id); });
  if (world()->getRank() == 1) values.at(0) = std::numeric_limits<double>::infinity();
  const auto write = [&](const std::string& name) {
    file.write(0, 0, "push", owned_coordinates(mesh), {{name, "Pa", 1, values}}, {});
  };
  EXPECT_NE(message_of<std::runtime_error>([&] { write("pore pressure"); }).find("'pore pressure'"), std::string::npos);
  EXPECT_THROW(write(world()->getRank() == 0 ? "a" : "b"), std::invalid_argument);
}

TEST(FieldFile, RestartsOnTwoRanks) {
  Folder folder;
  const Mesh mesh(world(), Geometry::plane_strain, world()->getRank() == 0 ? two_shapes(3) : GlobalMesh());
  write_run(mesh, folder / "r");
  FieldFile file(mesh, folder / "r", FieldRestart{1});
  EXPECT_EQ(file.num_steps(), 1);
  file.write(2, 2, "push", owned_coordinates(mesh), {}, {}, {{"cone", {0.0, -5.0}}});
  EXPECT_EQ(file.num_steps(), 2);
}

}  // namespace
}  // namespace mudline
