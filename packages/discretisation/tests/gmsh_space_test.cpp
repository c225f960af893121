#ifdef MUDLINE_HAVE_GMSH
#include <gtest/gtest.h>

#include "discretisation/mesh_quality.hpp"
#include "discretisation/mesh_topology.hpp"
#include "discretisation/space_filling_curve.hpp"
#include "discretisation/tests/mesh_fixture.hpp"

namespace mudline {
namespace {

using namespace mesh_test;

constexpr double pi = 3.14159265358979323846;

std::string order_of(int order) { return parameter("order", "int", std::to_string(order)); }

/// The quarter cylinder of data/cylinder.geo, whose wall is curved.
void expect_cylinder(const Mesh& mesh, double tolerance) {
  EXPECT_EQ(mesh.regions(), (std::vector<std::string>{"sand", "clay"}));
  EXPECT_NEAR(area(mesh, "sand"), 0.25 * pi, tolerance);
  EXPECT_NEAR(area(mesh, "clay"), 0.25 * pi, tolerance);
  // a surface between two volumes stands for the side of the volume that its normal points away from: here the sand
  const std::map<std::string, std::array<double, 4>> expected{{"bottom", {0.25 * pi, 0, 0, -0.25 * pi}},
                                                              {"top", {0.25 * pi, 0, 0, 0.25 * pi}},
                                                              {"left", {2, -2, 0, 0}},
                                                              {"front", {2, 0, -2, 0}},
                                                              {"wall", {pi, 2, 2, 0}},
                                                              {"middle", {0.25 * pi, 0, 0, 0.25 * pi}}};
  for (const auto& [set, values] : expected) {
    const auto sum = side_integral(mesh, set);
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(i == 3 && set == "middle" ? std::abs(sum[i]) : sum[i], values[i], tolerance) << set << " " << i;
  }
  ASSERT_EQ(mesh.nodes_of_set("tip").size(), 1u);
  EXPECT_NEAR(mesh.coordinates()(mesh.nodes_of_set("tip")[0], 2), 2, 1e-12);
  EXPECT_GT(mesh.nodes_of_set("axis").size(), 4u);
  for (int node : mesh.nodes_of_set("axis"))
    EXPECT_NEAR(std::hypot(mesh.coordinates()(node, 0), mesh.coordinates()(node, 1)), 0, 1e-12);
  EXPECT_LT(gradient_error(mesh), 1e-10);
}

TEST(GmshInSpace, TetrahedraOfBothOrders) {
  const auto straight = make(gmsh3("cylinder.geo", order_of(1))), curved = make(gmsh3("cylinder.geo"));
  EXPECT_EQ(straight->blocks()[0].shape, CellShape::tet4);
  EXPECT_EQ(curved->blocks()[0].shape, CellShape::tet10);
  expect_cylinder(*straight, 0.1);
  expect_cylinder(*curved, 2e-3);
  EXPECT_GT(mesh_quality(*curved, curved->coordinates()).lowest, 0.05);
  EXPECT_EQ(mesh_parts(*curved).places.size(), 1u);
}

TEST(GmshInSpace, HexahedraOfBothOrdersTurnedOver) {
  for (const auto& [order, shape] : {std::pair{1, CellShape::hex8}, {2, CellShape::hex27}}) {
    const auto mesh = make(gmsh3("bricks.geo", order_of(order)));
    ASSERT_EQ(mesh->blocks().size(), 1u);
    EXPECT_EQ(mesh->blocks()[0].shape, shape);
    EXPECT_EQ(mesh->num_global_elements(), 24);
    EXPECT_NEAR(area(*mesh, "1"), 24, 1e-11);
    EXPECT_NEAR(side_integral(*mesh, "top")[3], 12, 1e-11);
    EXPECT_NEAR(side_integral(*mesh, "bottom")[3], -12, 1e-11);
    EXPECT_NEAR(mesh_quality(*mesh, mesh->coordinates()).lowest, 1, 1e-9) << "nodes in the wrong order bend cells";
    EXPECT_LT(gradient_error(*mesh), 1e-11);
  }
}

TEST(GmshInSpace, HexahedraOfTwentyNodesGetCentres) {
  const auto mesh = make(gmsh3("hex20.geo")), whole = make(gmsh3("bricks.geo"));
  ASSERT_EQ(mesh->blocks().size(), 1u);
  EXPECT_EQ(mesh->blocks()[0].shape, CellShape::hex27);
  EXPECT_EQ(mesh->num_global_nodes(), whole->num_global_nodes());
  EXPECT_NEAR(area(*mesh, "1"), 24, 1e-11);
  EXPECT_NEAR(side_integral(*mesh, "top")[3], 12, 1e-11);
  EXPECT_NEAR(mesh_quality(*mesh, mesh->coordinates()).lowest, 1, 1e-9);
}

TEST(GmshInSpace, PrismsOfSixFifteenAndEighteenNodes) {
  for (const auto& [entries, shape] : {std::pair{gmsh3("prisms.geo", order_of(1)), CellShape::wedge6},
                                       {gmsh3("prisms15.geo"), CellShape::wedge15},
                                       {gmsh3("prisms.geo"), CellShape::wedge18}}) {
    const auto mesh = make(entries);
    ASSERT_EQ(mesh->blocks().size(), 1u);
    EXPECT_EQ(mesh->blocks()[0].shape, shape);
    EXPECT_NEAR(area(*mesh), 0.5, 1e-12);
    EXPECT_LT(gradient_error(*mesh), 1e-11) << "nodes in the wrong order bend cells";
    const ElementBlock& block = mesh->blocks()[0];
    for (int e = 0; e < block.num_elements; ++e)
      for (int a = 0; a < num_nodes(shape); ++a) {
        const auto place = map_of(*mesh, block, e).at(reference_node(shape, a).data());
        Point mean{};
        for (int c : corners_around(shape, a))
          for (int i = 0; i < 3; ++i)
            mean[i] += mesh->coordinates()(block.nodes(e, c), i) / corners_around(shape, a).size();
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(place[i], mean[i], 1e-9) << name(shape) << " node " << a;
      }
  }
}

TEST(GmshInSpace, PrismsBesideHexahedra) {
  const auto straight = make(gmsh3("mixed.geo", order_of(1)));
  for (const char* file : {"mixed.geo", "mixed20.geo"}) {
    const auto mesh = make(gmsh3(file));
    std::set<CellShape> shapes;
    for (const ElementBlock& block : mesh->blocks()) shapes.insert(block.shape);
    EXPECT_EQ(shapes, (std::set<CellShape>{CellShape::hex27, CellShape::wedge18})) << file;
    EXPECT_EQ(mesh->num_global_elements(), straight->num_global_elements());
    EXPECT_NEAR(area(*mesh), 1.5, 1e-12);
    EXPECT_LT(gradient_error(*mesh), 1e-11);
    EXPECT_EQ(mesh_parts(*mesh).places.size(), 1u);
    EXPECT_NEAR(side_integral(*mesh, "top")[3], 1.5, 1e-12) << "quadrilaterals and triangles";
    EXPECT_NEAR(side_integral(*mesh, "front")[2], -2, 1e-12);
  }
}

TEST(GmshInSpace, CadFileThatAGeometryMerges) {
  const auto mesh = make(gmsh3("post.geo"));
  EXPECT_NEAR(area(*mesh, "post"), 0.5 * pi, 1e-2);
  EXPECT_NEAR(side_integral(*mesh, "skin")[0], 2.5 * pi, 1e-2);
  EXPECT_NEAR(side_integral(*mesh, "skin")[3], 0, 1e-9) << "closed";
}

TEST(GmshInSpace, NeighboursAreCloseInMemory) {
  const auto mesh = make(gmsh3("cylinder.geo", order_of(1) + "<ParameterList name=\"parameters\">" +
                                                   parameter("size", "double", "0.15") + "</ParameterList>"));
  double jumps = 0;
  int count = 0;
  for (const ElementBlock& block : mesh->blocks())
    for (int e = 1; e < block.num_elements; ++e, ++count) {
      const Point a = map_of(*mesh, block, e - 1).at(cell_centre(block.shape).data()),
                  b = map_of(*mesh, block, e).at(cell_centre(block.shape).data());
      jumps += std::sqrt(std::pow(a[0] - b[0], 2) + std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2));
    }
  EXPECT_LT(jumps / count, 2 * 0.15);
}

TEST(GmshInSpace, HilbertsCurveVisitsEveryCellAndGoesOnToANeighbour) {
  for (int dim : {2, 3}) {
    const int n = 8;
    std::map<std::uint64_t, std::array<int, 3>> cells;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < (dim == 2 ? 1 : n); ++k) {
          const double t[3] = {(i + 0.5) / n, (j + 0.5) / n, (k + 0.5) / n};
          cells[along_curve(t, dim)] = {i, j, k};
        }
    ASSERT_EQ(cells.size(), static_cast<std::size_t>(dim == 2 ? n * n : n * n * n));
    const std::array<int, 3>* before = nullptr;
    for (const auto& [position, cell] : cells) {
      int steps = 0;
      if (before)
        for (int i = 0; i < 3; ++i) steps += std::abs(cell[i] - (*before)[i]);
      EXPECT_TRUE(!before || steps == 1) << dim;
      before = &cell;
    }
  }
}

TEST(GmshInSpace, Errors) {
  const auto message = [](const std::string& entries) {
    const std::string text = input_error([&] { make(entries); });
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 0) << text;
    EXPECT_CONTAINS(text, "deck.xml:1: mesh");
    return text;
  };
  EXPECT_CONTAINS(
      message(gmsh3("pyramids.geo", order_of(1))),
      "region 'soil' has elements of the type 'Pyramid 5'; allowed: tetrahedra of 4 or 10 nodes, hexahedra of "
      "8, 20 or 27, prisms of 6, 15 or 18");
  EXPECT_CONTAINS(message(gmsh3("quads.geo")), "there are no three-dimensional elements in it");
  EXPECT_CONTAINS(message(gmsh3("no_volume_group.geo")),
                  "elements of volume 1 belong to no physical group; add a Physical Volume for each region");
  EXPECT_CONTAINS(message(gmsh3("two_volume_groups.geo")), "volume 1 is in two physical groups, 'clay' and 'sand'");
  EXPECT_CONTAINS(message(gmsh3("loose_surface.geo")), "the surface group 'afar' has a face from (");
  EXPECT_CONTAINS(message(gmsh3("loose_surface.geo")), "that is no side of an element");
  EXPECT_CONTAINS(message(gmsh("bricks.geo")), "mesh");
  EXPECT_CONTAINS(message(gmsh3("cone_22.msh")), "there are no three-dimensional elements in it");
}

}  // namespace
}  // namespace mudline
#endif
