#include <gtest/gtest.h>

#include "discretisation/mesh_topology.hpp"
#include "discretisation/tests/mesh_fixture.hpp"

namespace mudline {
namespace {

using namespace mesh_test;

/// Boxes of one hex8 each, with nodes of their own.
GlobalMesh boxes(const std::vector<Bounds>& list) {
  GlobalMesh mesh;
  mesh.blocks = {{"soil", CellShape::hex8, {}}};
  for (const Bounds& box : list)
    for (int c = 0; c < 8; ++c) {
      const auto xi = reference_node(CellShape::hex8, c);
      mesh.blocks[0].nodes.push_back(static_cast<long long>(mesh.coordinates.size()));
      Point x;
      for (int i = 0; i < 3; ++i) x[i] = xi[i] < 0 ? box.low[i] : box.high[i];
      mesh.coordinates.push_back(x);
    }
  return mesh;
}

Bounds cube(double x, double y, double z, double size = 1) { return {{x, y, z}, {x + size, y + size, z + size}}; }

/// The boxes with common nodes: one node at each place.
GlobalMesh joined(const std::vector<Bounds>& list) {
  GlobalMesh mesh = boxes(list);
  std::vector<Point> places;
  for (long long& node : mesh.blocks[0].nodes) {
    const Point x = mesh.coordinates[node];
    const auto found = std::find(places.begin(), places.end(), x);
    node = found - places.begin();
    if (found == places.end()) places.push_back(x);
  }
  mesh.coordinates = places;
  return mesh;
}

/// A box as a source delivers it.
GlobalMesh whole(const std::string& cell, int x, int y, int z) {
  Registry<MeshSource> sources("mesh source");
  register_mesh_sources(sources);
  return sources.create(mesh_section(box3(cell, x, y, z)))->generate();
}

std::string message(const GlobalMesh& mesh, Geometry geometry = Geometry::space) {
  return input_error([&] { Mesh(world(), geometry, mesh); });
}

TEST(CheckSpace, DimensionsMustBeThoseOfTheGeometry) {
  const GlobalMesh mesh = boxes({cube(0, 0, 0)});
  EXPECT_EQ(mesh.dimension(), 3);
  EXPECT_NO_THROW(Mesh(world(), Geometry::space, mesh));
  EXPECT_CONTAINS(message(mesh, Geometry::plane_strain),
                  "region 'soil' has hex8 cells, which are of space; they need the geometry 'three-dimensional'");
  GlobalMesh plane;
  plane.coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  plane.blocks = {{"floor", CellShape::quad4, {0, 1, 2, 3}}};
  EXPECT_CONTAINS(message(plane), "region 'floor' has quad4 cells, which are of the plane");
  GlobalMesh both = mesh;
  both.blocks.push_back({"skin", CellShape::quad4, {0, 1, 2, 3}});
  EXPECT_CONTAINS(message(both), "region 'skin' has quad4 cells");
}

TEST(CheckSpace, InvertedFlatAndLoose) {
  GlobalMesh mesh = boxes({cube(0, 0, 0)});
  mesh.blocks[0].nodes = {4, 5, 6, 7, 0, 1, 2, 3};
  EXPECT_CONTAINS(message(mesh), "element with negative Jacobian in region 'soil' centred at (0.5, 0.5, 0.5)");
  mesh = boxes({{{0, 0, 0}, {1, 1, 0}}});
  EXPECT_CONTAINS(message(mesh), "element with zero Jacobian");
  mesh = boxes({cube(0, 0, 0)});
  mesh.coordinates.push_back({7, 8, 9});
  EXPECT_CONTAINS(message(mesh), "1 nodes of the mesh belong to no element; the first is at (7, 8, 9)");
  mesh = boxes({cube(0, 0, 0)});
  mesh.coordinates[6][2] = std::nan("");
  EXPECT_CONTAINS(message(mesh), "not finite");
  GlobalMesh tet10 = whole("tet10", 2, 2, 2);
  const long long* nodes = tet10.blocks[0].nodes.data();  // a mid-side node at the end of its edge
  tet10.coordinates[nodes[4]] = tet10.coordinates[nodes[0]];
  EXPECT_CONTAINS(message(tet10), "Jacobian");
}

TEST(CheckSpace, NeighboursFit) {
  GlobalMesh mesh = joined({cube(0, 0, 0), cube(1, 0, 0)});
  EXPECT_EQ(mesh.coordinates.size(), 12u);
  EXPECT_NO_THROW(Mesh(world(), Geometry::space, mesh));
  const std::vector<long long> first(mesh.blocks[0].nodes.begin(), mesh.blocks[0].nodes.begin() + 8);
  mesh.blocks.push_back({"rock", CellShape::hex8, first});
  EXPECT_CONTAINS(message(mesh), "elements overlap: two of them have the same side, one is in region 'rock'");
  // the upper nodes of the common face exchanged: the second cell is twisted by a right angle at that end
  GlobalMesh twisted = joined({cube(0, 0, 0), cube(1, 0, 0)});
  auto& nodes = twisted.blocks[0].nodes;  // common face of the second one: its corners 0, 3, 7, 4
  twisted.coordinates[nodes[8]] = {0.5, 0.5, 0.45};
  std::swap(nodes[8 + 0], nodes[8 + 4]);
  const std::string text = message(twisted);
  EXPECT_TRUE(contains(text, "go round in different orders") || contains(text, "Jacobian")) << text;
}

TEST(CheckSpace, NeighboursShareMiddles) {
  for (const auto& [cell, corners, edges] :
       {std::tuple{"tet10", 4, 6}, {"hex27", 8, 12}, {"wedge15", 6, 9}, {"wedge18", 6, 9}}) {
    GlobalMesh mesh = whole(cell, 2, 2, 2);
    auto& nodes = mesh.blocks[0].nodes;
    const int n = num_nodes(mesh.blocks[0].shape), edge = corners + edges - 1;
    // one edge of the last element gets a mid-side node of its own in that element
    const std::size_t at = nodes.size() - n + edge;
    for (std::size_t a = nodes.size() - n + corners; a < at; ++a)
      if (std::count(nodes.begin(), nodes.end(), nodes[a]) > 1) {
        mesh.coordinates.push_back(mesh.coordinates[nodes[a]]);
        nodes[a] = static_cast<long long>(mesh.coordinates.size()) - 1;
        break;
      }
    EXPECT_CONTAINS(message(mesh), "neighbours do not share the node in the middle of their common edge from (");
  }
  GlobalMesh mesh = whole("hex27", 2, 1, 1);
  auto& nodes = mesh.blocks[0].nodes;
  mesh.coordinates.push_back(mesh.coordinates[nodes[27 + 20]]);  // the face at low x
  nodes[27 + 20] = static_cast<long long>(mesh.coordinates.size()) - 1;
  EXPECT_CONTAINS(message(mesh),
                  "neighbours do not share the node in the middle of their common face at (1, 0.5, 0.75)");
}

/// A hexahedron with a wedge on its face at high x, whose ridge lies along y.
GlobalMesh hexahedron_and_wedge(CellShape wedge) {
  GlobalMesh mesh = whole("hex27", 1, 1, 1);
  const std::vector<long long> hex = mesh.blocks[0].nodes;
  std::vector<long long> nodes(num_nodes(wedge), -1);
  for (const auto& [own, of_hex] :
       {std::pair{0, 1}, {1, 5}, {3, 2}, {4, 6}, {6, 17}, {9, 18}, {12, 9}, {13, 13}, {15, 21}})
    if (own < num_nodes(wedge)) nodes[own] = hex[of_hex];
  const auto add = [&](int own, const Point& place) {
    nodes[own] = static_cast<long long>(mesh.coordinates.size());
    mesh.coordinates.push_back(place);
  };
  for (const int ridge : {2, 5}) {
    const Point& beside = mesh.coordinates[nodes[ridge - 2]];
    add(ridge, {beside[0] + 1, beside[1], beside[2] + 0.5});
  }
  for (int a = 6; a < num_nodes(wedge); ++a) {
    if (nodes[a] >= 0) continue;
    Point middle{};
    const auto& around = corners_around(wedge, a);
    for (const int c : around) middle += 1.0 / around.size() * mesh.coordinates[nodes[c]];
    add(a, middle);
  }
  mesh.blocks.push_back({"ridge", wedge, nodes});
  return mesh;
}

TEST(CheckSpace, WedgesBesideHexahedra) {
  EXPECT_CONTAINS(message(hexahedron_and_wedge(CellShape::wedge15)),
                  "neighbours do not fit: their common side has 9 nodes in one and 8 in the other, which is in region "
                  "'ridge' centred at (");
  const GlobalMesh fits = hexahedron_and_wedge(CellShape::wedge18);
  EXPECT_NO_THROW(Mesh(world(), Geometry::space, fits));
  EXPECT_EQ(seams(fits), "");
}

TEST(CheckSpace, SoundMeshesHaveNoSeams) {
  for (const char* cell : {"hex27", "tet10", "hex8", "tet4", "wedge6", "wedge15", "wedge18"})
    EXPECT_EQ(seams(whole(cell, 3, 2, 3)), "") << cell;
  GlobalMesh thin = whole("hex8", 3, 3, 3);
  for (auto& x : thin.coordinates) x[2] *= 1e-3;
  EXPECT_EQ(seams(thin), "") << "thin elements are no seams";
  EXPECT_EQ(seams(boxes({cube(0, 0, 0), cube(1, 1, 1)})), "") << "they touch at a corner only";
  EXPECT_EQ(seams(boxes({cube(0, 0, 0), cube(1, 1, 0)})), "") << "they touch along an edge only";
  EXPECT_EQ(seams(boxes({cube(0, 0, 0), cube(1.1, 0.3, 0)})), "") << "a gap that is seen";
}

TEST(CheckSpace, TwinNodesAreACrack) {
  GlobalMesh mesh = boxes({cube(0, 0, 0), cube(1, 0, 0)});
  EXPECT_CONTAINS(seams(mesh), "a crack of twin nodes: two elements have a face at (1, 0.5, 0.5) each; join them");
  mesh.side_sets["left face"] = {{0, 0, 1}};
  mesh.side_sets["right face"] = {{0, 1, 0}};
  EXPECT_CONTAINS(seams(mesh), "a crack of twin nodes");
  mesh.contacts.pairs = {{"right face", "left face"}};
  EXPECT_EQ(seams(mesh), "");
  mesh.contacts.pairs.clear();
  EXPECT_EQ(seams(mesh, {"left face"}), "");
  EXPECT_CONTAINS(seams(whole("hex8", 1, 1, 1), {"top"}), "no side of it lies beside another one");
  const MeshParts parts = mesh_parts(Mesh(world(), Geometry::space, mesh));
  ASSERT_EQ(parts.places.size(), 2u);
  EXPECT_EQ(parts.places[1], (Point{1, 0, 0}));
  EXPECT_EQ(parts.of_set.at("right face"), std::vector<int>{1});
}

TEST(CheckSpace, HangingNodesAndFacesThatDoNotFit) {
  const GlobalMesh hanging =
      joined({cube(0, 0, 0), {{1, 0, 0}, {2, 1, 0.5}}, {{1, 0, 0.5}, {2, 1, 1}}});  // one beside two halves
  const std::string text = seams(hanging);
  EXPECT_CONTAINS(text, "the mesh has a hanging node at (1, ");
  EXPECT_CONTAINS(text, ", 0.5): it lies on the face at (1, 0.5, 0.5) of an element that does not have it");
  EXPECT_CONTAINS(seams(boxes({cube(0, 0, 0), cube(1, 0.3, 0.2)})), "two parts of the mesh lie beside each other at");
  EXPECT_CONTAINS(seams(boxes({cube(0, 0, 0), cube(1.01, 0.3, 0.2)})), "lie beside each other") << "a gap nobody sees";
  // two tetrahedra's faces on the face of a hexahedron, with the same corners
  GlobalMesh mixed = boxes({cube(0, 0, 0)});
  mixed.coordinates.push_back({2, 0.5, 0.5});
  mixed.blocks.push_back({"rock", CellShape::tet4, {1, 6, 2, 8, 1, 5, 6, 8}});
  for (int e = 0; e < 2; ++e) {
    long long* n = mixed.blocks[1].nodes.data() + 4 * e;
    if (element_map(mixed, 1, e).determinant(cell_centre(CellShape::tet4).data()) < 0) std::swap(n[1], n[2]);
  }
  EXPECT_CONTAINS(seams(mixed), "elements do not fit: the face at (1, ");
}

TEST(CheckSpace, MeshesOverEachOther) {
  EXPECT_CONTAINS(seams(boxes({cube(0, 0, 0), cube(0, 0, 0)})), "the mesh lies over itself at ") << "wholly";
  EXPECT_CONTAINS(seams(boxes({cube(0, 0, 0), cube(0.4, 0.3, 0.2)})), "the mesh lies over itself at ") << "partly";
  EXPECT_CONTAINS(seams(boxes({cube(0, 0, 0), cube(0.95, 0, 0)})), "the mesh lies over itself at ") << "by a twentieth";
  GlobalMesh inside = boxes({cube(0, 0, 0), cube(0.3, 0.3, 0.3, 0.2)});
  EXPECT_CONTAINS(seams(inside), "the mesh lies over itself at (");
}

TEST(CheckSpace, Holes) {
  for (const char* cell : {"hex8", "tet10"}) {
    GlobalMesh mesh = whole(cell, 3, 3, 3);
    const int per_cell = cell[0] == 'h' ? 1 : 6, n = num_nodes(mesh.blocks[0].shape);
    const auto remove = [&](int hexahedron) {
      auto& nodes = mesh.blocks[0].nodes;
      nodes.erase(nodes.begin() + hexahedron * per_cell * n, nodes.begin() + (hexahedron + 1) * per_cell * n);
      mesh.side_sets.clear();
    };
    GlobalMesh notch = mesh;
    remove(13);
    EXPECT_CONTAINS(seams(mesh), "a hole around (1, 0.5, 0.75) whose faces are in no side set") << cell;
    for (const ElementSide& side : boundary_sides(mesh))  // name one face of it
      if (mesh.side_sets["cave"].empty() && std::abs(middle_of(mesh, side)[2] - 1) < 1e-9)
        mesh.side_sets["cave"].push_back(side.place);
    EXPECT_EQ(seams(mesh), "") << cell;
    mesh = notch;
    remove(4);
    EXPECT_EQ(seams(mesh), "") << "a pit in the bottom";
  }
}

TEST(CheckSpace, InnerSidesOfSets) {
  GlobalMesh mesh = joined({cube(0, 0, 0), cube(1, 0, 0)});
  mesh.side_sets["wall"] = {{0, 0, 0}, {0, 0, 1}};
  mesh.side_sets["top"] = {{0, 0, 5}, {0, 1, 5}};
  const Mesh made(world(), Geometry::space, mesh);
  const Section section = mesh_section(parameter("side", "string", "wall"));
  EXPECT_CONTAINS(input_error([&] { require_boundary(made, section, "side", "wall"); }),
                  "mesh/side: side set 'wall' has a side between two elements, at (1, 0.5, 0.5)");
  EXPECT_NO_THROW(require_boundary(made, section, "side", "top"));
}

TEST(CheckSpace, KeysOfSides) {
  const long long there[] = {7, 3, 9, 5}, back[] = {9, 3, 7, 5}, crossed[] = {3, 7, 9, 5};
  EXPECT_EQ(sorted_key(there, 4), sorted_key(back, 4));
  EXPECT_EQ(directed_key(there, 4), (SideKey{3, 9, 5, 7}));
  EXPECT_EQ(reversed_key(directed_key(there, 4)), directed_key(back, 4));
  EXPECT_NE(reversed_key(directed_key(there, 4)), directed_key(crossed, 4));
  EXPECT_EQ(directed_key(there, 3), (SideKey{3, 9, 7, -1}));
  EXPECT_EQ(reversed_key(directed_key(there, 3)), (SideKey{3, 7, 9, -1}));
  EXPECT_EQ(directed_key(there, 2), (SideKey{7, 3, -1, -1}));
  EXPECT_EQ(reversed_key(directed_key(there, 2)), (SideKey{3, 7, -1, -1}));
}

}  // namespace
}  // namespace mudline
