#include <gtest/gtest.h>

#include "discretisation/mesh_topology.hpp"
#include "discretisation/tests/mesh_fixture.hpp"
#include "tensor/vec.hpp"

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
  EXPECT_CONTAINS(message(crack), "do not share the node in the middle of their common side from (0, 0) to (1, 1)");
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

/// Squares of one quad4 each with nodes of their own, given by their lower left corners.
GlobalMesh apart(const std::vector<Vec<double, 2>>& corners, double size = 1) {
  GlobalMesh mesh;
  mesh.blocks = {{"soil", CellShape::quad4, {}}};
  for (const auto& c : corners)
    for (const auto& d : {Vec<double, 2>{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}}) {
      mesh.blocks[0].nodes.push_back(static_cast<long long>(mesh.coordinates.size()));
      mesh.coordinates.push_back({c[0] + size * d[0], c[1] + size * d[1]});
    }
  return mesh;
}

TEST(CheckMesh, TwinNodesAreACrack) {
  GlobalMesh mesh = apart({{0, 0}, {1, 0}});
  EXPECT_CONTAINS(seams(mesh), "a crack of twin nodes: two elements have a side from (1, 1) to (1, 0) each; join them");
  // surfaces in contact, one of them on each side
  mesh.side_sets["left face"] = {{0, 0, 1}};
  mesh.side_sets["right face"] = {{0, 1, 3}};
  EXPECT_CONTAINS(seams(mesh), "a crack of twin nodes");
  // a contact of a surface with itself is refused where contacts are read, with the deck's line
  mesh.contacts.pairs = {{"left face", "left face"}};
  EXPECT_EQ(seams(mesh), "");
  mesh.contacts.pairs = {{"right face", "left face"}};
  EXPECT_EQ(seams(mesh), "");
  // an intended crack
  mesh.contacts.pairs.clear();
  EXPECT_EQ(seams(mesh, {"left face"}), "");
  const MeshParts parts = mesh_parts(Mesh(world(), Geometry::plane_strain, mesh));
  EXPECT_EQ(parts.places.size(), 2u);
  EXPECT_EQ(parts.places[1], (Point{1, 0, 0}));
  EXPECT_EQ(parts.of_set.at("left face"), std::vector<int>{0});
  EXPECT_EQ(parts.of_set.at("right face"), std::vector<int>{1});
}

TEST(CheckMesh, CracksMustBeThere) {
  GlobalMesh mesh = two_quads();
  mesh.side_sets["top"] = {{0, 0, 2}};
  EXPECT_CONTAINS(seams(mesh, {"top"}), "'cracks' names 'top', but no side of it lies beside another one");
  EXPECT_CONTAINS(seams(mesh, {"tpo"}), "'cracks' names 'tpo', which is no side set");
}

TEST(CheckMesh, HangingNode) {
  // a square beside two halves of its height
  GlobalMesh mesh;
  mesh.coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {2, 0.5}, {1, 0.5}, {2, 1}};
  mesh.blocks = {{"soil", CellShape::quad4, {0, 1, 2, 3, 1, 4, 5, 6, 6, 5, 7, 2}}};
  EXPECT_CONTAINS(seams(mesh), "hanging node at (1, 0.5): it lies on the side from (1, 0) to (1, 1)");
  mesh.side_sets["face"] = {{0, 0, 1}};
  EXPECT_CONTAINS(seams(mesh, {"face"}), "hanging node") << "not what a crack looks like";
}

TEST(CheckMesh, MeshesThatDoNotMatch) {
  EXPECT_CONTAINS(seams(apart({{0, 0}, {1, 0.3}})), "two parts of the mesh lie beside each other at (1, 0.5)");
  EXPECT_CONTAINS(seams(apart({{0, 0}, {1.01, 0.3}})), "lie beside each other") << "a gap that nobody sees";
  EXPECT_EQ(seams(apart({{0, 0}, {1.1, 0.3}})), "");
  EXPECT_EQ(seams(apart({{0, 0}, {1, 1}})), "") << "they touch at a corner only";
}

TEST(CheckMesh, ThinElementsAreNoSeams) {
  GlobalMesh mesh = two_quads();
  for (auto& x : mesh.coordinates) x[1] *= 1e-3;
  EXPECT_EQ(seams(mesh), "");
}

TEST(CheckMesh, MeshesOverEachOther) {
  EXPECT_CONTAINS(seams(apart({{0, 0}, {0, 0}})), "the mesh lies over itself at ") << "wholly";
  EXPECT_CONTAINS(seams(apart({{0, 0}, {0.4, 0.3}})), "the mesh lies over itself at ") << "partly";
  EXPECT_CONTAINS(seams(apart({{0, 0}, {0.95, 0}})), "the mesh lies over itself at ") << "by a twentieth";
  GlobalMesh inside = apart({{0, 0}});
  const GlobalMesh small = apart({{0.3, 0.3}}, 0.2);
  inside.coordinates.insert(inside.coordinates.end(), small.coordinates.begin(), small.coordinates.end());
  inside.blocks.push_back({"stone", CellShape::quad4, {4, 5, 6, 7}});
  EXPECT_CONTAINS(seams(inside), "in an element of region 'stone' and in another one of region 'soil'");
}

TEST(CheckMesh, CurvedSidesBesideEachOther) {
  // two tri6 on the two sides of an arc, which bulges by a tenth of its chord
  GlobalMesh mesh;
  mesh.coordinates = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.57, 0.57}, {0, 0.5},
                      {1, 0}, {1, 1}, {0, 1}, {1, 0.5}, {0.5, 1},     {0.57, 0.57}};
  mesh.blocks = {{"soil", CellShape::tri6, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}}};
  EXPECT_CONTAINS(seams(mesh), "a crack of twin nodes");
  mesh.coordinates[11] = {0.67, 0.67};  // a lens between them
  EXPECT_EQ(seams(mesh), "");
  mesh.coordinates[11] = {0.47, 0.47};
  EXPECT_CONTAINS(seams(mesh), "the mesh lies over itself at ");
}

/// A grid of 3 x 3 squares without one of them.
GlobalMesh grid_without(int missing) {
  GlobalMesh mesh;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) mesh.coordinates.push_back({double(i), double(j)});
  mesh.blocks = {{"soil", CellShape::quad4, {}}};
  for (int e = 0; e < 9; ++e) {
    const long long a = 4 * (e / 3) + e % 3;
    if (e != missing) mesh.blocks[0].nodes.insert(mesh.blocks[0].nodes.end(), {a, a + 1, a + 5, a + 4});
  }
  return mesh;
}

TEST(CheckMesh, Holes) {
  GlobalMesh mesh = grid_without(4);
  EXPECT_CONTAINS(seams(mesh), "a hole around (1.5, 1.5) whose edge is in no side set");
  mesh.side_sets["tunnel"] = {{0, 1, 2}};
  EXPECT_EQ(seams(mesh), "");
  EXPECT_EQ(seams(grid_without(1)), "") << "a notch";
  // a missing triangle with a corner on the boundary
  GlobalMesh fan;
  fan.coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}, {0.3, 0.7}, {0.7, 0.3}};
  fan.blocks = {{"soil", CellShape::tri3, {0, 1, 6, 1, 2, 6, 6, 2, 4, 4, 2, 5, 5, 2, 3, 3, 0, 5, 5, 0, 4, 4, 0, 6}}};
  EXPECT_EQ(seams(fan), "");
  auto& nodes = fan.blocks[0].nodes;
  nodes.erase(nodes.begin() + 6, nodes.begin() + 9);
  EXPECT_CONTAINS(seams(fan), "a hole around (0.75, 0.65)");
}

TEST(CheckMesh, InnerSidesOfSets) {
  GlobalMesh mesh = two_quads();
  mesh.side_sets["wall"] = {{0, 0, 0}, {0, 0, 1}};
  mesh.side_sets["top"] = {{0, 0, 2}};
  const Mesh made(world(), Geometry::plane_strain, mesh);
  const Section section = mesh_section(parameter("side", "string", "wall"));
  EXPECT_CONTAINS(input_error([&] { require_boundary(made, section, "side", "wall"); }),
                  "mesh/side: side set 'wall' has a side between two elements, at (1, 0.5)");
  EXPECT_NO_THROW(require_boundary(made, section, "side", "top"));
  EXPECT_EQ(mesh_parts(made).places.size(), 1u);
}

}  // namespace
}  // namespace mudline
