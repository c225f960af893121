#include <gtest/gtest.h>

#include "discretisation/mesh_quality.hpp"
#include "discretisation/mesh_topology.hpp"
#include "discretisation/tests/mesh_fixture.hpp"

namespace mudline {
namespace {

using namespace mesh_test;

TEST(MeshQualityOnTwoRanks, TheWorstElementIsKnownToAll) {
  const auto mesh = make(box("quad4", 4, 4));
  const auto& x = mesh->coordinates();
  for (int node = 0; node < mesh->num_nodes(); ++node)  // a node of the last square, on one rank only
    if (std::abs(x(node, 0) - 2) < 1e-9 && std::abs(x(node, 1) - 1) < 1e-9) x(node, 0) = 1.6, x(node, 1) = 0.8;
  const MeshQuality quality = mesh_quality(*mesh, x);
  EXPECT_LT(quality.lowest, 0);
  EXPECT_EQ(quality.folded, 1);
  EXPECT_NEAR(quality.place[0], 0.25 * (1.5 + 2 + 1.6 + 1.5), 1e-12);
  EXPECT_NEAR(quality.place[1], 0.25 * (0.75 + 0.75 + 0.8 + 1), 1e-12);
}

/// A row of squares in which the last two have nodes of their own.
GlobalMesh two_parts() {
  GlobalMesh mesh;
  mesh.blocks = {{"soil", CellShape::quad4, {}}};
  for (int part = 0; part < 2; ++part)
    for (int e = 0; e < 6; ++e) {
      const long long first = 14 * part + 2 * e;
      mesh.blocks[0].nodes.insert(mesh.blocks[0].nodes.end(), {first, first + 2, first + 3, first + 1});
    }
  for (int part = 0; part < 2; ++part)
    for (int i = 0; i < 7; ++i)
      for (int j = 0; j < 2; ++j) mesh.coordinates.push_back({10. * part + i, double(j)});
  mesh.side_sets["wall"] = {{0, 3, 0}, {0, 8, 1}};
  mesh.side_sets["floor"] = {{0, 7, 0}};
  return mesh;
}

TEST(MeshTopologyOnTwoRanks, PartsAndInnerSides) {
  const Mesh mesh(world(), Geometry::plane_strain, two_parts());
  const MeshParts parts = mesh_parts(mesh);
  ASSERT_EQ(parts.places.size(), 2u);
  EXPECT_EQ(parts.places[1], (Point{10, 0, 0}));
  EXPECT_EQ(parts.of_set.at("wall"), (std::vector<int>{0, 1}));
  EXPECT_EQ(parts.of_set.at("floor"), std::vector<int>{1});
  const Section section = mesh_section(parameter("side", "string", "wall"));
  EXPECT_CONTAINS(input_error([&] { require_boundary(mesh, section, "side", "wall"); }),
                  "side set 'wall' has a side between two elements, at (13, 0.5)");
  EXPECT_NO_THROW(require_boundary(mesh, section, "side", "floor"));
}

}  // namespace
}  // namespace mudline
