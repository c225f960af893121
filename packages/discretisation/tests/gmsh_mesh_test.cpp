#ifdef MUDLINE_HAVE_GMSH
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "discretisation/tests/mesh_fixture.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

using namespace mesh_test;

constexpr double pi = 3.14159265358979323846;

std::string override_with(const std::string& name, const std::string& value) {
  return "<ParameterList name=\"parameters\">" + parameter(name, "double", value) + "</ParameterList>";
}

/// A rectangle of 3 x 2 with a quarter of a circle cut out; the lower surface was made clockwise.
void expect_cone(const Mesh& mesh, double radius, double tolerance) {
  EXPECT_EQ(mesh.regions(), (std::vector<std::string>{"sand", "clay"}));
  EXPECT_NEAR(area(mesh, "sand"), 3, 1e-9);
  EXPECT_NEAR(area(mesh, "clay"), 3 - 0.25 * pi * radius * radius, tolerance);
  EXPECT_EQ(mesh.side_set_names(), (std::vector<std::string>{"axis", "bottom", "interface", "notch", "right"}));
  const std::map<std::string, Vec<double, 3>> expected{{"axis", {2 - radius, -(2 - radius), 0}},
                                                       {"bottom", {3, 0, -3}},
                                                       {"right", {2, 2, 0}},
                                                       {"notch", {0.5 * pi * radius, -radius, radius}},
                                                       {"interface", {3, 0, 3}}};
  for (const auto& [set, values] : expected) {
    const auto sum = side_integral(mesh, set);
    const double allowed = set == "notch" ? tolerance : 1e-9;
    EXPECT_NEAR(sum[0], values[0], allowed) << set;
    // A line inside the soil stands for the element on its left: above or below, here the curve runs from right to
    // left.
    EXPECT_NEAR(sum[1], values[1], 1e-9) << set;
    EXPECT_NEAR(sum[2], values[2], 1e-9) << set;
  }
  ASSERT_EQ(mesh.nodes_of_set("tip").size(), 1u);
  EXPECT_NEAR(mesh.coordinates()(mesh.nodes_of_set("tip")[0], 1), 2 - radius, 1e-12);
  EXPECT_EQ(mesh.node_sets().at("tip"), mesh.nodes_of_set("tip"));
  EXPECT_EQ(mesh.bounds().high[0], 3) << "the point that no line uses is no node";
}

TEST(GmshMesh, GeometryIsMeshed) {
  const auto mesh = make(gmsh("cone.geo"));
  expect_cone(*mesh, 0.5, 2e-3);
  EXPECT_EQ(mesh->blocks()[0].shape, CellShape::tri6);
}

TEST(GmshMesh, GeometryOfOrderOne) {
  const auto mesh = make(gmsh("cone.geo", parameter("order", "int", "1") + override_with("size", "0.05")));
  EXPECT_EQ(mesh->blocks()[0].shape, CellShape::tri3);
  expect_cone(*mesh, 0.5, 2e-3);
}

TEST(GmshMesh, ParametersOverrideTheGeometrys) {
  const auto mesh = make(gmsh("cone.geo", override_with("radius", "0.75")));
  expect_cone(*mesh, 0.75, 1e-2);
  EXPECT_GT(make(gmsh("cone.geo", override_with("size", "0.1")))->num_global_elements(),
            10 * mesh->num_global_elements());
}

TEST(GmshMesh, FilesOfBothVersions) {
  const auto old = make(gmsh("cone_22.msh")), recent = make(gmsh("cone_41.msh")), fresh = make(gmsh("cone.geo"));
  expect_cone(*old, 0.5, 2e-3);
  expect_cone(*recent, 0.5, 2e-3);
  EXPECT_EQ(old->num_global_elements(), recent->num_global_elements());
  EXPECT_EQ(old->num_global_nodes(), recent->num_global_nodes());
  for (int n = 0; n < old->num_nodes(); ++n) EXPECT_NEAR(old->coordinates()(n, 0), recent->coordinates()(n, 0), 1e-12);
}

TEST(GmshMesh, QuadrilateralsOfBothOrders) {
  for (const auto& [order, shape] : {std::pair{"1", CellShape::quad4}, {"2", CellShape::quad9}}) {
    const auto mesh = make(gmsh("quads.geo", parameter("order", "int", order)));
    ASSERT_EQ(mesh->blocks().size(), 1u);
    EXPECT_EQ(mesh->blocks()[0].shape, shape);
    EXPECT_EQ(mesh->num_global_elements(), 12);
    EXPECT_NEAR(area(*mesh, "1"), 12, 1e-12) << "a group without a name is called by its number";
    EXPECT_NEAR(side_integral(*mesh, "top")[2], 4, 1e-12);
  }
}

TEST(GmshMesh, QuadrilateralsOfEightNodesGetCentres) {
  const auto mesh = make(gmsh("quad8.geo"));
  EXPECT_EQ(mesh->blocks()[0].shape, CellShape::quad9);
  expect_cone(*mesh, 0.5, 2e-3);
}

/// The file was written by Gmsh 4.8 with lines between partitions and ghost elements: a rectangle of 2 x 1 in three
/// parts.
TEST(GmshMesh, PartitionedFile) {
  const auto mesh = make(gmsh("partitioned_41.msh"));
  EXPECT_EQ(mesh->regions(), std::vector<std::string>{"soil"});
  EXPECT_EQ(mesh->num_global_elements(), 86);
  EXPECT_NEAR(area(*mesh, "soil"), 2, 1e-12);
  EXPECT_EQ(mesh->side_set_names(), (std::vector<std::string>{"bottom", "left", "right", "sides", "top"}));
  EXPECT_NEAR(side_integral(*mesh, "top")[2], 2, 1e-12);
  EXPECT_NEAR(side_integral(*mesh, "sides")[0], 2, 1e-12);
  EXPECT_EQ(mesh->node_sets().size(), 1u);
  EXPECT_EQ(mesh->nodes_of_set("corner").size(), 1u);
}

TEST(GmshMesh, OneMeshLeavesNoTraceInTheNext) {
  const long long elements = make(gmsh("cone.geo"))->num_global_elements();
  make(gmsh("cone.geo", override_with("size", "0.2")));
  input_error([&] { make(gmsh("syntax_error.geo")); });
  EXPECT_EQ(make(gmsh("cone.geo"))->num_global_elements(), elements);
  make(gmsh("quad8.geo"));
  EXPECT_EQ(make(gmsh("quads.geo"))->blocks()[0].shape, CellShape::quad9);
}

TEST(GmshMesh, NeighboursAreCloseInMemory) {
  const auto mesh = make(gmsh("cone.geo", override_with("size", "0.05")));
  const ElementBlock& block = mesh->blocks()[0];
  double jumps = 0;
  for (int e = 1; e < block.num_elements; ++e)
    jumps += std::hypot(mesh->coordinates()(block.nodes(e, 0), 0) - mesh->coordinates()(block.nodes(e - 1, 0), 0),
                        mesh->coordinates()(block.nodes(e, 0), 1) - mesh->coordinates()(block.nodes(e - 1, 0), 1));
  EXPECT_LT(jumps / block.num_elements, 3 * 0.05);
}

TEST(GmshMesh, Errors) {
  const auto message = [](const std::string& file, const std::string& more = "") {
    const std::string text = input_error([&] { make(gmsh(file, more)); });
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 0) << text;
    EXPECT_CONTAINS(text, "deck.xml:1: mesh");
    return text;
  };
  EXPECT_CONTAINS(message("missing.geo"), "mesh/file: the file 'missing.geo' does not exist");
  EXPECT_CONTAINS(message("deck.txt"), "does not exist");
  EXPECT_CONTAINS(message("notes.txt"), "mesh/file: expected a .msh or .geo file, given 'notes.txt'");
  EXPECT_CONTAINS(message("no_newline.geo"), "mesh/file: 'no_newline.geo' has no newline at its end");
  EXPECT_CONTAINS(message("syntax_error.geo"), "mesh/file: Gmsh, reading 'syntax_error.geo': ");
  EXPECT_CONTAINS(message("broken.msh"), "mesh/file: Gmsh, reading 'broken.msh': ");
  EXPECT_CONTAINS(message("no_surface.geo"), "there are no two-dimensional elements in it");
  EXPECT_CONTAINS(message("no_group.geo"), "elements of surface 1 belong to no physical group; add a Physical Surface");
  EXPECT_CONTAINS(message("two_groups.geo"), "surface 2 is in two physical groups, 'clay' and 'rock'");
  EXPECT_CONTAINS(message("lone_point.geo"), "the point group 'far' has a point at (7, 7) that no element uses");
  EXPECT_CONTAINS(message("out_of_plane.geo"), "the mesh is not in the x-y plane");
  EXPECT_CONTAINS(message("cone_22.msh", parameter("order", "int", "1")),
                  "region 'sand' has tri6 elements, which are of order 2, but 'order' is 1");
  EXPECT_CONTAINS(message("cone_22.msh", override_with("radius", "1")), "a .msh file has no parameters");
  EXPECT_CONTAINS(message("cone.geo", override_with("radios", "1")),
                  "mesh/parameters/radios: unknown parameter 'radios' of 'cone.geo'; it defines radius, size");
  EXPECT_CONTAINS(message("no_surface.geo", override_with("radius", "1")), "it defines none");
  EXPECT_CONTAINS(message("cone.geo", "<ParameterList name=\"parameters\">" + parameter("radius", "string", "big") +
                                          "</ParameterList>"),
                  "mesh/parameters/radius: expected a number");
  EXPECT_CONTAINS(message("cone.geo", override_with("radius", "5")), "elements overlap");
  // a boundary that cuts itself: some versions of Gmsh report it, others never return
  EXPECT_CONTAINS(message("cone.geo", override_with("radius", "2") + parameter("time limit", "double", "20")),
                  "mesh/file: Gmsh, reading 'cone.geo'");
  EXPECT_CONTAINS(message("cone.geo", override_with("size", "-2")), "mesh/file: Gmsh, reading 'cone.geo': Wrong mesh");
}

TEST(GmshMesh, GeometryThatMergesAFileWhoseGroupsShareAnElementaryTag) {
  EXPECT_CONTAINS(
      input_error([] { make(gmsh("merged_shared.geo", parameter("order", "int", "1"))); }),
      "mesh/file: 'merged_shared.geo' merges 'shared.msh', where lines of different physical groups have the "
      "same elementary tag, 1; Gmsh would put all of them in all of these groups");
  const auto mesh = make(gmsh("merged.geo"));  // one tag for each group
  EXPECT_EQ(mesh->side_set_names(), (std::vector<std::string>{"axis", "bottom", "interface", "notch", "right"}));
}

TEST(GmshMesh, TimeLimit) {
  const std::string text = input_error(
      [&] { make(gmsh("cone.geo", parameter("time limit", "double", "1e-4") + override_with("size", "0.003"))); });
  EXPECT_CONTAINS(text, "mesh/file: Gmsh, reading 'cone.geo', had not finished after 0.0001 s and was stopped");
  EXPECT_CONTAINS(text, "'time limit' gives it more time");
}

TEST(GmshMesh, SizesInAnotherUnitThanCoordinatesAreRefused) {
  const auto start = std::chrono::steady_clock::now();
  const std::string text = input_error([] { make(gmsh("cone.geo", override_with("size", "0.5e-3"))); });
  EXPECT_CONTAINS(text, "mesh/file: Gmsh divides the curves of 'cone.geo' into ");
  EXPECT_CONTAINS(text,
                  " sides, too many for a model that is 7 m across: are its coordinates in mm and its sizes in m?");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60)) << "before the faces are filled";
}

TEST(GmshMesh, PointSetIsNoSideSet) {
  const auto mesh = make(gmsh("cone.geo"));
  const Section section = mesh_section(parameter("side", "string", "tip"));
  EXPECT_CONTAINS(input_error([&] { require_side_set(*mesh, section, "side", "tip"); }),
                  "mesh/side: 'tip' is a set of points, a set of sides is needed");
}

}  // namespace
}  // namespace mudline
#endif
