#include <gtest/gtest.h>

#include "discretisation/tests/mesh_fixture.hpp"

namespace mudline {
namespace {

using namespace mesh_test;

/// Two quad4 side by side on [0, 2] x [0, 1].
GlobalMesh two_quads() {
  GlobalMesh mesh;
  mesh.coordinates = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
  mesh.blocks = {{"soil", CellShape::quad4, {0, 1, 4, 3, 1, 2, 5, 4}}};
  return mesh;
}

std::string message(const GlobalMesh& mesh, Geometry geometry = Geometry::plane_strain) {
  return input_error([&] { Mesh(world(), geometry, mesh); });
}

TEST(CheckMesh, AcceptsASoundMesh) {
  const Mesh mesh(world(), Geometry::axisymmetric, two_quads());
  EXPECT_EQ(mesh.num_global_elements(), 2);
  EXPECT_EQ(mesh.geometry(), Geometry::axisymmetric);
}

TEST(CheckMesh, OrphanNodes) {
  GlobalMesh mesh = two_quads();
  mesh.coordinates.push_back({7, 8});
  EXPECT_EQ(message(mesh), "1 nodes of the mesh belong to no element; the first is at (7, 8)");
}

TEST(CheckMesh, NoElements) { EXPECT_EQ(message({}), "the mesh has no elements"); }

TEST(CheckMesh, InvertedFlatAndFoldedElements) {
  GlobalMesh mesh = two_quads();
  mesh.blocks[0].nodes = {0, 1, 4, 3, 1, 4, 5, 2};
  EXPECT_CONTAINS(message(mesh), "element with negative Jacobian in region 'soil' centred at (1.5, 0.5)");
  mesh = two_quads();
  mesh.coordinates[2] = {1, 0};
  mesh.coordinates[5] = {1, 1};
  EXPECT_CONTAINS(message(mesh), "element with zero Jacobian");
  mesh = two_quads();
  mesh.coordinates[4] = {0.1, 0.2};  // a dent beyond the diagonal
  EXPECT_CONTAINS(message(mesh), "negative Jacobian");
  mesh = two_quads();
  mesh.coordinates[0][0] = std::nan("");
  EXPECT_CONTAINS(message(mesh), "not finite");
}

TEST(CheckMesh, OverlapAndMisfit) {
  GlobalMesh mesh = two_quads();
  mesh.blocks.push_back({"rock", CellShape::quad4, {0, 1, 4, 3}});
  EXPECT_CONTAINS(message(mesh), "elements overlap");

  GlobalMesh crack;
  crack.coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 0.5}, {0.5, 0.5}};
  crack.blocks = {{"soil", CellShape::tri6, {0, 1, 2, 4, 5, 6, 0, 2, 3, 9, 7, 8}}};
  EXPECT_CONTAINS(message(crack), "do not share the middle node of their common side from (0, 0) to (1, 1)");
}

TEST(CheckMesh, MixedOrders) {
  GlobalMesh mesh = two_quads();
  mesh.coordinates.insert(mesh.coordinates.end(), {{3, 0}, {2.5, 0}, {2.5, 0.5}, {2, 0.5}});
  mesh.blocks.push_back({"rock", CellShape::tri6, {2, 6, 5, 7, 8, 9}});
  EXPECT_EQ(message(mesh), "the mesh mixes linear and quadratic elements: quad4 in region 'soil', tri6 in 'rock'");
}

TEST(CheckMesh, NegativeRadius) {
  GlobalMesh mesh = two_quads();
  mesh.coordinates[3][0] = -0.25;
  EXPECT_CONTAINS(message(mesh, Geometry::axisymmetric), "radii x >= 0, but has a node at (-0.25, 1)");
  EXPECT_NO_THROW(Mesh(world(), Geometry::plane_strain, mesh));
}

TEST(CheckMesh, Sets) {
  GlobalMesh mesh = two_quads();
  mesh.side_sets["top"] = {};
  EXPECT_EQ(message(mesh), "the side set 'top' is empty");
  mesh.side_sets["top"] = {{0, 0, 2}, {0, 0, 2}};
  EXPECT_EQ(message(mesh), "a side occurs twice in the side set 'top'");
  mesh.side_sets["top"] = {{0, 0, 2}};
  mesh.node_sets["top"] = {3};
  EXPECT_EQ(message(mesh), "the name 'top' belongs to a set of sides and to a set of points");
}

}  // namespace
}  // namespace mudline
