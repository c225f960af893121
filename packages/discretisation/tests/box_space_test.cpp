#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "discretisation/mesh_quality.hpp"
#include "discretisation/tests/mesh_fixture.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

using namespace mesh_test;

const char* const cells[] = {"hex27", "tet10", "hex8", "tet4", "wedge6", "wedge15", "wedge18"};

std::string distorted(const char* amount = "0.3") { return parameter("distortion", "double", amount); }

TEST(BoxInSpace, CountsAndVolumes) {
  struct Case {
    const char* cell;
    int elements, nodes, vertices;
  };
  for (const Case& c :
       {Case{"hex27", 24, 315, 60}, Case{"tet10", 144, 315, 60}, Case{"hex8", 24, 60, 60}, Case{"tet4", 144, 60, 60},
        Case{"wedge6", 48, 60, 60}, Case{"wedge15", 48, 315 - 86, 60}, Case{"wedge18", 48, 315, 60}}) {
    const auto mesh = make(box3(c.cell, 4, 3, 2));
    EXPECT_EQ(mesh->geometry(), Geometry::space);
    EXPECT_EQ(mesh->dimension(), 3);
    EXPECT_EQ(mesh->coordinates().extent(1), 3u);
    EXPECT_EQ(mesh->num_global_elements(), c.elements) << c.cell;
    EXPECT_EQ(mesh->num_global_nodes(), c.nodes) << c.cell;
    EXPECT_EQ(std::count(mesh->is_vertex().begin(), mesh->is_vertex().end(), 1), c.vertices) << c.cell;
    EXPECT_NEAR(area(*mesh), 3.0, 1e-13) << c.cell;
    EXPECT_EQ(mesh->bounds().low, (Point{0, 0, 0}));
    EXPECT_EQ(mesh->bounds().high, (Point{2, 1, 1.5}));
    EXPECT_EQ(mesh->bounds().extent(), 2);
  }
}

TEST(BoxInSpace, Hex27IsTheDefault) {
  const auto mesh =
      make(parameter("type", "string", "box") + parameter("geometry", "string", "three-dimensional") +
           parameter("cells", "Array(int)", "{1, 1, 1}") + parameter("lower", "Array(double)", "{1, 2, 3}") +
           parameter("upper", "Array(double)", "{2, 4, 6}"));
  EXPECT_EQ(mesh->blocks()[0].shape, CellShape::hex27);
  EXPECT_EQ(mesh->bounds().low, (Point{1, 2, 3}));
  EXPECT_NEAR(area(*mesh), 6, 1e-13);
}

TEST(BoxInSpace, SidesPointOutwards) {
  const std::map<std::string, Vec<double, 3>> expected{{"left", {-1.5, 0, 0}}, {"right", {1.5, 0, 0}},
                                                       {"front", {0, -3, 0}},  {"back", {0, 3, 0}},
                                                       {"bottom", {0, 0, -2}}, {"top", {0, 0, 2}}};
  for (const char* cell : cells) {
    const auto mesh = make(box3(cell, 4, 3, 2, distorted()));
    EXPECT_EQ(mesh->side_set_names(), (std::vector<std::string>{"back", "bottom", "front", "left", "right", "top"}));
    for (const auto& [set, normal] : expected) {
      const auto sum = side_integral(*mesh, set);
      EXPECT_NEAR(sum[0], std::abs(normal[0] + normal[1] + normal[2]), 1e-13) << cell << " " << set;
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum[1 + i], normal[i], 1e-13) << cell << " " << set;
    }
    const int per_cell = order(mesh->blocks()[0].shape);
    EXPECT_EQ(static_cast<int>(mesh->nodes_of_set("top").size()), (4 * per_cell + 1) * (3 * per_cell + 1));
    for (int node : mesh->nodes_of_set("back")) EXPECT_EQ(mesh->coordinates()(node, 1), 1.0);
  }
}

TEST(BoxInSpace, LinearFieldsAreExactOnDistortedMeshes) {
  for (const char* cell : cells) {
    const auto mesh = make(box3(cell, 4, 3, 4, distorted()));
    EXPECT_NEAR(area(*mesh), 3.0, 1e-13) << cell;
    EXPECT_LT(gradient_error(*mesh), 1e-12) << cell;
  }
}

TEST(BoxInSpace, DistortionKeepsMiddlesAndTheBoundary) {
  for (const char* cell : {"hex27", "tet10", "wedge15", "wedge18"}) {
    const auto straight = make(box3(cell, 4, 3, 4)), moved = make(box3(cell, 4, 3, 4, distorted()));
    double largest = 0;
    for (int n = 0; n < moved->num_nodes(); ++n) {
      double square = 0;
      for (int i = 0; i < 3; ++i) square += std::pow(moved->coordinates()(n, i) - straight->coordinates()(n, i), 2);
      largest = std::max(largest, std::sqrt(square));
    }
    EXPECT_GT(largest, 0.3 * 0.333 * 0.5);
    EXPECT_LE(largest, 0.3 * 0.375);
    const ElementBlock& block = moved->blocks()[0];
    for (int e = 0; e < block.num_elements; ++e)
      for (int a = num_corners(block.shape); a < num_nodes(block.shape); ++a) {
        Point mean{};
        const auto around = corners_around(block.shape, a);
        for (int c : around)
          for (int i = 0; i < 3; ++i) mean[i] += moved->coordinates()(block.nodes(e, c), i) / around.size();
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(moved->coordinates()(block.nodes(e, a), i), mean[i], 1e-14);
      }
  }
}

TEST(BoxInSpace, GradingIsTheRatioOfLastToFirstCell) {
  const auto mesh = make(box3("hex8", 2, 2, 3, parameter("grading", "Array(double)", "{1.0, 2.0, 4.0}")));
  const auto& x = mesh->coordinates();
  EXPECT_NEAR((x(6, 1) - x(3, 1)) / (x(3, 1) - x(0, 1)), 2, 1e-13);
  EXPECT_NEAR((x(27, 2) - x(18, 2)) / (x(9, 2) - x(0, 2)), 4, 1e-13);
  EXPECT_NEAR((x(18, 2) - x(9, 2)) / (x(9, 2) - x(0, 2)), 2, 1e-13);
}

TEST(BoxInSpace, LayersAreByZ) {
  for (const char* cell : {"tet10", "hex8"}) {
    const auto mesh = make(box3(cell, 2, 2, 3,
                                parameter("layer tops", "Array(double)", "{0.5}") +
                                    parameter("layer regions", "Array(string)", "{sand, clay}")));
    EXPECT_NEAR(area(*mesh, "sand"), 1.0, 1e-13);
    EXPECT_NEAR(area(*mesh, "clay"), 2.0, 1e-13);
    EXPECT_EQ(mesh->region_bounds().at("clay").low, (Point{0, 0, 0.5}));
  }
}

/// An element with all its nodes on the boundary of the box would have no node that can move.
TEST(BoxInSpace, NoTetrahedronHasAllItsNodesOnTheSides) {
  for (const auto& [x, y, z] : {std::array{2, 2, 2}, {3, 2, 4}, {5, 3, 3}}) {
    const auto mesh = make(box3("tet4", x, y, z));
    std::set<int> on_sides;
    for (const std::string& set : mesh->side_set_names())
      on_sides.insert(mesh->nodes_of_set(set).begin(), mesh->nodes_of_set(set).end());
    const ElementBlock& block = mesh->blocks()[0];
    for (int e = 0; e < block.num_elements; ++e) {
      int fixed = 0;
      for (int a = 0; a < 4; ++a) fixed += on_sides.count(block.nodes(e, a)) != 0;
      EXPECT_LT(fixed, 4) << x << " " << y << " " << z;
    }
  }
}

TEST(BoxInSpace, QualityOfCubesAndTheirSixTetrahedra) {
  const std::string cube = parameter("upper", "Array(double)", "{1.0, 1.0, 1.0}") + parameter("type", "string", "box") +
                           parameter("geometry", "string", "three-dimensional") +
                           parameter("cells", "Array(int)", "{2, 2, 2}");
  for (const auto& [cell, expected] :
       {std::pair{"hex27", 1.0}, {"hex8", 1.0}, {"tet4", 1 / std::sqrt(3.0)}, {"tet10", 1 / std::sqrt(3.0)}}) {
    const auto mesh = make(cube + parameter("cell", "string", cell));
    const MeshQuality quality = mesh_quality(*mesh, mesh->coordinates());
    // det 1, edges of a corner 1, sqrt 2, sqrt 3: the worst of the tetrahedra's corners has sqrt 2 / sqrt 6
    EXPECT_NEAR(quality.lowest, expected, 1e-12) << cell;
    EXPECT_EQ(quality.folded, 0);
  }
}

TEST(BoxInSpace, Errors) {
  const auto message = [](const std::string& entries) { return input_error([&] { make(entries); }); };
  EXPECT_CONTAINS(message(box3("quad9", 2, 2, 2)),
                  "mesh/cell: 'quad9' is a cell of the plane, and the geometry is 'three-dimensional'; allowed: hex27, "
                  "tet10, hex8, tet4, wedge15, wedge18, wedge6");
  const std::string start = parameter("type", "string", "box") + parameter("geometry", "string", "three-dimensional") +
                            parameter("upper", "Array(double)", "{1.0, 1.0, 1.0}");
  EXPECT_CONTAINS(message(start + parameter("cells", "Array(int)", "{2, 2}")),
                  "mesh/cells: expected 3 numbers, given 2");
  EXPECT_CONTAINS(message(start + parameter("cells", "Array(int)", "{200, 200, 200}")),
                  "mesh/cells: expected at most 5e+06 cells in all, given 8e+06");
  const auto more = [&](const std::string& name, const std::string& value) {
    return message(box3("hex8", 2, 2, 2, parameter(name, "Array(double)", value)));
  };
  EXPECT_CONTAINS(more("lower", "{0, 0}"), "mesh/lower: expected 3 numbers, given 2");
  EXPECT_CONTAINS(more("lower", "{0, 0, 2}"),
                  "mesh/upper: must lie above and right of 'lower' (0, 0, 2), given (2, 1, 1.5)");
  EXPECT_CONTAINS(more("grading", "{1, 1}"), "mesh/grading: expected 3 numbers, given 2");
  EXPECT_CONTAINS(more("grading", "{1, 1, -1}"), "mesh/grading: must be positive");
  EXPECT_CONTAINS(message(box3("hex8", 2, 2, 2,
                               parameter("layer tops", "Array(double)", "{0.4}") +
                                   parameter("layer regions", "Array(string)", "{a, b}"))),
                  "mesh/layer tops: the layer top z = 0.4 is on no cell line; the nearest is z = 0.75");
  EXPECT_CONTAINS(message(box3("hex8", 2, 2, 2, parameter("cracks", "Array(string)", "{tpo}"))),
                  "mesh: 'cracks' names 'tpo', which is no side set");
}

}  // namespace
}  // namespace mudline
