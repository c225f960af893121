#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "discretisation/tests/mesh_fixture.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

using namespace mesh_test;

TEST(BoxMesh, CountsAndAreas) {
  struct Case {
    const char* cell;
    int elements, nodes, vertices;
  };
  for (const Case& c :
       {Case{"quad9", 12, 63, 20}, Case{"tri6", 24, 63, 20}, Case{"quad4", 12, 20, 20}, Case{"tri3", 24, 20, 20}}) {
    const auto mesh = make(box(c.cell, 4, 3));
    EXPECT_EQ(mesh->num_global_elements(), c.elements) << c.cell;
    EXPECT_EQ(mesh->num_global_nodes(), c.nodes) << c.cell;
    EXPECT_EQ(mesh->num_nodes(), c.nodes) << c.cell;
    EXPECT_EQ(mesh->num_owned_nodes(), c.nodes) << c.cell;
    EXPECT_EQ(std::count(mesh->is_vertex().begin(), mesh->is_vertex().end(), 1), c.vertices) << c.cell;
    EXPECT_NEAR(area(*mesh), 2.0, 1e-14) << c.cell;
    EXPECT_EQ(mesh->regions(), std::vector<std::string>{"soil"});
    EXPECT_EQ(mesh->dimension(), 2);
    EXPECT_EQ(mesh->bounds().low, (Point{0, 0, 0}));
    EXPECT_EQ(mesh->bounds().high, (Point{2, 1, 0}));
  }
}

TEST(BoxMesh, SidesPointOutwards) {
  for (const char* cell : {"quad9", "tri6", "quad4", "tri3"}) {
    const auto mesh = make(box(cell, 4, 3, parameter("distortion", "double", "0.3")));
    EXPECT_EQ(mesh->side_set_names(), (std::vector<std::string>{"bottom", "left", "right", "top"}));
    const std::map<std::string, Vec<double, 3>> expected{
        {"left", {1, -1, 0}}, {"right", {1, 1, 0}}, {"bottom", {2, 0, -2}}, {"top", {2, 0, 2}}};
    for (const auto& [set, values] : expected) {
      const auto sum = side_integral(*mesh, set);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum[i], values[i], 1e-14) << cell << " " << set;
    }
    const int per_cell = mesh->blocks()[0].shape == linear_partner(mesh->blocks()[0].shape) ? 1 : 2;
    EXPECT_EQ(static_cast<int>(mesh->nodes_of_set("top").size()), 4 * per_cell + 1);
    for (int node : mesh->nodes_of_set("top")) EXPECT_EQ(mesh->coordinates()(node, 1), 1.0);
  }
}

TEST(BoxMesh, DistortionMovesVerticesOnlyAndKeepsMiddles) {
  for (const char* cell : {"quad9", "tri6"}) {
    const auto straight = make(box(cell, 6, 5)),
               moved = make(box(cell, 6, 5, parameter("distortion", "double", "0.3")));
    const auto again = make(box(cell, 6, 5, parameter("distortion", "double", "0.3")));
    EXPECT_NEAR(area(*moved), 2.0, 1e-14);
    double largest = 0;
    for (int n = 0; n < moved->num_nodes(); ++n) {
      EXPECT_EQ(moved->coordinates()(n, 0), again->coordinates()(n, 0));
      largest = std::max(largest, std::hypot(moved->coordinates()(n, 0) - straight->coordinates()(n, 0),
                                             moved->coordinates()(n, 1) - straight->coordinates()(n, 1)));
    }
    EXPECT_GT(largest, 0.3 * 0.2 * 0.5);
    EXPECT_LE(largest, 0.3 * 0.2);
    const ElementBlock& block = moved->blocks()[0];
    const int corners = num_corners(block.shape);
    for (int e = 0; e < block.num_elements; ++e)
      for (int s = 0; s < corners; ++s)
        for (int d = 0; d < 2; ++d)
          EXPECT_NEAR(moved->coordinates()(block.nodes(e, corners + s), d),
                      0.5 * (moved->coordinates()(block.nodes(e, s), d) +
                             moved->coordinates()(block.nodes(e, (s + 1) % corners), d)),
                      1e-15);
  }
}

TEST(BoxMesh, GradingIsTheRatioOfLastToFirstCell) {
  const auto mesh = make(box("quad4", 4, 3, parameter("grading", "Array(double)", "{8.0, 0.25}")));
  const auto& x = mesh->coordinates();
  EXPECT_NEAR((x(4, 0) - x(3, 0)) / (x(1, 0) - x(0, 0)), 8, 1e-13);
  EXPECT_NEAR((x(2, 0) - x(1, 0)) / (x(1, 0) - x(0, 0)), 2, 1e-13);
  EXPECT_NEAR((x(15, 1) - x(10, 1)) / (x(5, 1) - x(0, 1)), 0.25, 1e-13);
}

TEST(BoxMesh, NoTriangleHasAllItsNodesOnTwoSides) {
  for (int n : {2, 3, 4, 5}) {
    const auto mesh = make(box("tri3", n, n + 1));
    std::vector<int> sets(mesh->num_nodes(), 0);
    for (const auto& item : mesh->side_sets())
      for (int node : mesh->nodes_of_set(item.first)) sets[node] = 1;
    const ElementBlock& block = mesh->blocks()[0];
    for (const auto& item : mesh->side_sets())
      for (const Side& side : item.second) {
        int fixed = 0;
        for (int a = 0; a < 3; ++a) fixed += sets[block.nodes(side.element, a)];
        EXPECT_TRUE(fixed < 3 || n == 2) << n;  // with two columns every triangle is near a side
      }
  }
}

TEST(BoxMesh, LayersAreRegions) {
  const auto mesh = make(box("tri6", 2, 4,
                             parameter("layer tops", "Array(double)", "{0.25, 0.75}") +
                                 parameter("layer regions", "Array(string)", "{sand, clay, sand}")));
  EXPECT_EQ(mesh->regions(), (std::vector<std::string>{"sand", "clay"}));
  EXPECT_NEAR(area(*mesh, "sand"), 1.0, 1e-14);
  EXPECT_NEAR(area(*mesh, "clay"), 1.0, 1e-14);
  EXPECT_EQ(mesh->region_bounds().at("clay").low, (Point{0, 0.25, 0}));
  EXPECT_EQ(mesh->region_bounds().at("clay").high, (Point{2, 0.75, 0}));
  EXPECT_NEAR(side_integral(*mesh, "left")[0], 1.0, 1e-14);
  EXPECT_EQ(mesh->blocks()[1].global_ids.front(), mesh->blocks()[0].num_elements);
}

TEST(BoxMesh, ElementsAndNodesKeepTheSourcesOrderOnOneRank) {
  const auto mesh = make(box("quad9", 3, 2));
  for (int n = 0; n < mesh->num_nodes(); ++n) EXPECT_EQ(mesh->node_ids()[n], n);
  for (int e = 0; e < 6; ++e) EXPECT_EQ(mesh->blocks()[0].global_ids[e], e);
}

TEST(BoxMesh, Errors) {
  const auto message = [](const std::string& entries) { return input_error([&] { make(entries); }); };
  EXPECT_CONTAINS(
      message(box("hex8", 2, 2)),
      "mesh/cell: 'hex8' is a cell of space, and the geometry is one of the plane; allowed: quad9, tri6, quad4, tri3");
  EXPECT_CONTAINS(message(box("hex9", 2, 2)), "'hex9' is not a choice");
  EXPECT_CONTAINS(message(parameter("type", "string", "bix")), "did you mean 'box'?");
  EXPECT_CONTAINS(message(parameter("type", "string", "box")), "required parameter 'cells' is missing");
  EXPECT_CONTAINS(message(box("quad9", 2, 2, parameter("geometry", "string", "axisymetric"))),
                  "did you mean 'axisymmetric'?");
  EXPECT_CONTAINS(message(box("quad9", 2, 2, parameter("gradin", "double", "1"))), "did you mean 'grading'?");
  EXPECT_CONTAINS(message(box("quad9", 0, 2)), "mesh/cells");
  EXPECT_CONTAINS(message(box("quad9", 2, 2, parameter("lower", "Array(double)", "{3.0, 0.0}"))),
                  "mesh/upper: must lie above and right of 'lower'");
  EXPECT_CONTAINS(message(box("quad9", 2, 2, parameter("distortion", "double", "0.5"))), "out of range");
  EXPECT_CONTAINS(message(box("quad9", 2, 2, parameter("grading", "Array(double)", "{1.0, 0.0}"))),
                  "mesh/grading: must be positive");
  const auto layers = [&](const std::string& tops, const std::string& regions) {
    return message(
        box("quad9", 2, 4,
            parameter("layer tops", "Array(double)", tops) + parameter("layer regions", "Array(string)", regions)));
  };
  EXPECT_CONTAINS(layers("{0.3}", "{a, b}"),
                  "mesh/layer tops: the layer top y = 0.3 is on no cell line; "
                  "the nearest is y = 0.25");
  EXPECT_CONTAINS(layers("{0.5}", "{a, b, c}"), "mesh/layer regions: expected 2 names");
  EXPECT_CONTAINS(layers("{0.5, 0.25}", "{a, b, c}"), "tops must ascend");
  EXPECT_CONTAINS(layers("{1.0}", "{a, b}"), "tops must ascend and lie inside the box");
  EXPECT_CONTAINS(message(box("quad4", 2, 2,
                              parameter("geometry", "string", "axisymmetric") +
                                  parameter("lower", "Array(double)", "{-1.0, 0.0}"))),
                  "mesh: an axisymmetric mesh needs radii x >= 0, but has a node at (-1, 0)");
}

TEST(MeshSets, UnknownNamesAreMetWithASuggestion) {
  const auto mesh = make(box("quad4", 2, 2));
  const Section section = mesh_section(parameter("side", "string", "tpo"));
  EXPECT_NO_THROW(require_side_set(*mesh, section, "side", "top"));
  EXPECT_CONTAINS(input_error([&] { require_side_set(*mesh, section, "side", "tpo"); }),
                  "deck.xml:1: mesh/side: unknown side set 'tpo' (did you mean 'top'?)");
  EXPECT_THROW(mesh->nodes_of_set("tpo"), std::logic_error);
}

}  // namespace
}  // namespace mudline
