#include <gtest/gtest.h>

#include "ale/conservation.hpp"
#include "ale/nodal_remap.hpp"
#include "ale/quality.hpp"
#include "ale/recovery.hpp"
#include "ale/remesher.hpp"
#include "ale_mesh.hpp"
#include "core/deck.hpp"
#include "discretisation/triangulation.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

using testing::box;
using testing::grains;
using testing::points_of;

/// A mesh of triangles with the objects that remesh it.
struct Remeshed {
  explicit Remeshed(CellShape shape, const std::string& entries = "", int n = 6) : mesh(box(shape, n)), whole(*mesh) {
    deck.overlay("<ParameterList name=\"deck\">" + entries + "</ParameterList>", "deck.xml");
    x = whole.gather(mesh->coordinates());
    boundary.bind(whole, x, {}, deck.root(), nullptr);
    plan = std::make_unique<Remesher>(whole, boundary, RemeshingParameters(), deck.root());
  }
  std::unique_ptr<Mesh> mesh;
  GhostedMesh whole;
  Deck deck;
  Positions x;
  BoundaryMotion boundary;
  std::unique_ptr<Remesher> plan;
};

std::unique_ptr<Mesh> mesh_of(const RemeshedMesh& made) {
  return std::make_unique<Mesh>(Tpetra::getDefaultComm(), Geometry::plane_strain, made.mesh);
}

double area(const GhostedMesh& mesh, const Positions& x, const SoilBlock& block) {
  Soil soil;
  soil.geometry = Geometry::plane_strain;
  soil.blocks = {block};
  return soil_volume(mesh, soil, x);
}

/// The box drawn out to three times its height, with a curved top.
Positions drawn_out(Positions x) {
  for (auto& p : x) p = {p[0], 3 * p[1] + 0.2 * p[1] * std::sin(3 * p[0])};
  return x;
}

TEST(Remesher, DrawnOutSidesAreDividedAndEverythingKeepsItsName) {
  for (CellShape shape : {CellShape::tri3, CellShape::tri6}) {
    Remeshed was(shape);
    EXPECT_NEAR(was.plan->largest_side(was.x, State()), 1, 1e-9);
    const Positions x = drawn_out(was.x);
    EXPECT_NEAR(was.plan->largest_side(x, State()), 3.3, 0.3);
    const RemeshedMesh made = was.plan->make(x, State(), 0.2, nullptr);
    const auto mesh = mesh_of(made);
    const GhostedMesh whole(*mesh);
    const Positions now = whole.gather(mesh->coordinates());
    EXPECT_GT(lowest_quality(whole, now), 0.4);
    ASSERT_EQ(made.paths.size(), was.boundary.paths().size());
    std::multiset<int> sides;
    for (std::size_t p = 0; p < made.paths.size(); ++p) {
      sides.insert(made.paths[p].num_vertices() - 1);
      EXPECT_EQ(made.paths[p].sets, was.boundary.paths()[p].sets);
      EXPECT_EQ(now[made.paths[p].nodes.front()], x[was.boundary.paths()[p].nodes.front()]);
      EXPECT_EQ(now[made.paths[p].nodes.back()], x[was.boundary.paths()[p].nodes.back()]);
    }
    EXPECT_EQ(*sides.begin(), 6);    // the straight bottom
    EXPECT_GE(*sides.rbegin(), 18);  // the sides, three times as long
    EXPECT_EQ(whole.side_sets().at("bottom").size(), 6u);
    EXPECT_EQ(mesh->blocks()[0].region, "soil");
    for (const auto& side : whole.side_sets().at("bottom"))
      EXPECT_EQ(now[whole.elements()[side.element].nodes[side.side]][1], 0.0);
    // The region is the same within the approximation of its curved top.
    EXPECT_NEAR(area(whole, now, points_of(*mesh)), area(was.whole, x, points_of(*was.mesh)),
                shape == CellShape::tri6 ? 1e-3 : 1e-2);
    EXPECT_EQ(RemeshedMesh::from_bytes(made.bytes()).bytes(), made.bytes());
  }
}

TEST(Remesher, MaterialSidesKeepTheirNodesAndTheRestIsAsWanted) {
  Deck deck;
  Remeshed was(CellShape::tri6);
  BoundaryMotion boundary;
  deck.overlay(
      "<ParameterList name=\"deck\"><Parameter name=\"material sides\" type=\"Array(string)\" "
      "value=\"{top}\"/></ParameterList>",
      "deck.xml");
  Parameters p(deck.root());
  boundary.parameters(p);
  boundary.bind(was.whole, was.x, {}, deck.root(), nullptr);
  const Remesher plan(was.whole, boundary, RemeshingParameters(), was.deck.root());
  const Positions x = drawn_out(was.x);
  const RemeshedMesh made = plan.make(x, State(), 0.2, nullptr);
  for (std::size_t k = 0; k < made.paths.size(); ++k) {
    if (!made.paths[k].sets.count("top")) continue;
    ASSERT_EQ(made.paths[k].nodes.size(), boundary.paths()[k].nodes.size());
    for (std::size_t i = 0; i < made.paths[k].nodes.size(); ++i)
      for (int d = 0; d < 2; ++d)
        EXPECT_EQ(made.mesh.coordinates[made.paths[k].nodes[i]][d], x[boundary.paths()[k].nodes[i]][d]);
  }
}

TEST(Remesher, RefusesAMeshThatIsTooPoor) {
  Remeshed was(CellShape::tri6);
  EXPECT_THROW(was.plan->make(was.x, State(), 0.99, nullptr), NoTriangulation);
}

TEST(Remesher, LinearFieldsSurviveAtNodesAndPointsAndQuadraticOnesAtNodes) {
  Remeshed was(CellShape::tri6);
  Positions x = was.x;
  for (auto& p : x) p = {1.3 * p[0] + 0.2 * p[1], 2.5 * p[1]};
  const RemeshedMesh made = was.plan->make(x, State(), 0.2, nullptr);
  const auto mesh = mesh_of(made);
  const GhostedMesh whole(*mesh);
  const Positions now = whole.gather(mesh->coordinates());
  EXPECT_GT(whole.num_nodes(), was.whole.num_nodes() * 3 / 2);
  const auto quadratic = [](const Point& p) { return 1 + p[0] - 2 * p[1] + 3 * p[0] * p[1] - p[1] * p[1]; };
  const auto linear = [](const Point& p) { return 3 - 2 * p[0] + 5 * p[1]; };
  std::vector<double> at_nodes, at_vertices;
  for (const auto& place : x) {
    at_nodes.push_back(quadratic(place));
    at_vertices.push_back(linear(place));
  }
  const NodalRemap nodal({was.whole, was.boundary.paths(), {}, x}, {whole, made.paths, {}, now});
  const auto all = nodal.apply(at_nodes, 1, Support::all_nodes), few = nodal.apply(at_vertices, 1, Support::vertices);
  for (int node = 0; node < whole.num_nodes(); ++node) {
    EXPECT_NEAR(all[node], quadratic(now[node]), 1e-12);
    if (whole.is_vertex(node)) {
      EXPECT_NEAR(few[node], linear(now[node]), 1e-12);
    }
  }
  SoilBlock old_block = points_of(*was.mesh), block = points_of(*mesh);
  const RecoveryPatches patches(was.whole, old_block);
  std::vector<double> table;  // a linear column, and a constant one
  for (int e : was.whole.block_elements(0))
    for (int q = 0; q < old_block.points; ++q) {
      table.push_back(linear(Recovery::position(was.whole.elements()[e], old_block, q, x)));
      table.push_back(7.25);
    }
  std::vector<double> there(2 * whole.block_elements(0).size() * block.points);
  const std::vector<StateVariable> variables{{"f", 1, "-"}, {"g", 1, "-"}};
  RecoveryRemap().transfer({{was.whole, old_block, x}, {whole, block, now}, patches, variables, 2, table, there});
  for (int e : whole.block_elements(0))
    for (int q = 0; q < block.points; ++q) {
      const std::size_t row = 2 * static_cast<std::size_t>(whole.first_row(e, block.points) + q);
      EXPECT_NEAR(there[row], linear(Recovery::position(whole.elements()[e], block, q, now)), 1e-12);
      EXPECT_NEAR(there[row + 1], 7.25, 1e-13);
      there[row] = 1.1;  // a void ratio
    }
  old_block.made_of = block.made_of = {0};
  for (std::size_t i = 0; i < table.size(); i += 2) table[i] = 0.75;
  Soil soil;
  soil.geometry = Geometry::axisymmetric;
  const double before = grains(was.whole, old_block, x, soil.geometry, table, 2),
               found = grains(whole, block, now, soil.geometry, there, 2);
  const auto restored = restore_grains(
      {{was.whole, old_block, x}, {whole, block, now}, patches, variables, 2, table, there}, soil, 0, -1);
  EXPECT_NEAR(restored[0].lost(), 1 - found / before, 1e-12);
  EXPECT_GT(restored[0].lost(), 0.1);
  EXPECT_NEAR(grains(whole, block, now, soil.geometry, there, 2) / before, 1, 1e-14);
}

/// A cube of tetrahedra whose top is curved, with the objects that remesh it.
struct RemeshedCube {
  explicit RemeshedCube(CellShape shape, double height = 0.8, const std::string& entries = "", double roof = 0)
      : mesh(testing::cube(shape, 3)), whole(*mesh) {
    deck.overlay(
        "<ParameterList name=\"deck\"><ParameterList name=\"boundary\">" + entries + "</ParameterList></ParameterList>",
        "deck.xml");
    for (BoundaryMotion* of_mesh : {&boundary, &after}) {
      Parameters p(deck.root().section("boundary"));
      of_mesh->parameters(p);
    }
    const Positions source = whole.gather(mesh->coordinates());
    boundary.bind(whole, source, {}, deck.root(), nullptr);
    plan = std::make_unique<Remesher>(whole, boundary, RemeshingParameters(), deck.root());
    x = source;
    for (auto& p : x) p = {1.3 * p[0] + 0.2 * p[1], 1.1 * p[1], height * p[2] + 0.1 * p[2] * std::sin(3 * p[0]) * p[1]};
    for (std::size_t node = 0; node < x.size(); ++node)
      x[node][2] *= 1 + roof * (0.5 - std::abs(source[node][0] - 0.5));
    // inner edges are straight
    for (const auto& element : whole.elements())
      for (int a = num_corners(shape); a < num_nodes(shape); ++a) {
        const auto [from, to] = edge_corners(shape, a - num_corners(shape));
        if (!whole.on_boundary(element.nodes[a]))
          x[element.nodes[a]] = 0.5 * (x[element.nodes[from]] + x[element.nodes[to]]);
      }
    made = plan->make(x, State(), 0.05, nullptr);
    next = std::make_unique<Mesh>(Tpetra::getDefaultComm(), Geometry::space, made.mesh);
    anew = std::make_unique<GhostedMesh>(*next);
    now = anew->gather(next->coordinates());
    after.bind(*anew, now, {}, deck.root(), &made);
  }
  std::unique_ptr<Mesh> mesh, next;
  GhostedMesh whole;
  std::unique_ptr<GhostedMesh> anew;
  Deck deck;
  Positions x, now;
  BoundaryMotion boundary, after;
  std::unique_ptr<Remesher> plan;
  RemeshedMesh made;
};

double volume(const GhostedMesh& mesh, const Positions& x, const SoilBlock& block) {
  Soil soil;
  soil.geometry = Geometry::space;
  soil.blocks = {block};
  return soil_volume(mesh, soil, x);
}

TEST(RemesherInSpace, TheBoundaryIsMeshedAnewAndEverythingKeepsItsName) {
  for (CellShape shape : {CellShape::tet4, CellShape::tet10}) {
    RemeshedCube cube(shape);
    EXPECT_NE(cube.whole.elements().size(), cube.anew->elements().size());
    EXPECT_GT(lowest_quality(*cube.anew, cube.now), 0.05);
    const double was = volume(cube.whole, cube.x, points_of(*cube.mesh, 5));
    EXPECT_NEAR(volume(*cube.anew, cube.now, points_of(*cube.next, 5)), was, 1e-3 * was);
    for (const auto& [name, sides] : cube.whole.side_sets()) ASSERT_TRUE(cube.anew->side_sets().count(name));
    std::map<std::string, double> area;
    for (const auto& [name, sides] : cube.anew->side_sets())
      for (const auto& side : sides) {
        const auto& element = cube.anew->elements()[side.element];
        const std::vector<int> at = side_nodes(element.shape, side.side);
        const auto corner = [&](int k) { return cube.now[element.nodes[at[k]]]; };
        area[name] += 0.5 * length(cross(corner(1) - corner(0), corner(2) - corner(0)));
        for (int a : at) {
          if (name == "bottom") EXPECT_EQ(cube.now[element.nodes[a]][2], 0.0);
          if (name == "back") EXPECT_EQ(cube.now[element.nodes[a]][1], 1.1);
        }
      }
    EXPECT_NEAR(area["bottom"], 1.3 * 1.1, 1e-12);
    EXPECT_EQ(RemeshedMesh::from_bytes(cube.made.bytes()).bytes(), cube.made.bytes());
    // Surfaces and curves are those of the first mesh.
    const MeshSurfaces &old = cube.boundary.surfaces().surfaces(), &now = cube.after.surfaces().surfaces();
    ASSERT_EQ(now.patches.size(), old.patches.size());
    for (std::size_t p = 0; p < old.patches.size(); ++p) EXPECT_EQ(now.patches[p].sets, old.patches[p].sets);
    ASSERT_EQ(cube.after.paths().size(), cube.boundary.paths().size());
    for (std::size_t p = 0; p < cube.after.paths().size(); ++p) {
      const std::vector<int>&here = cube.after.paths()[p].nodes, &there = cube.boundary.paths()[p].nodes;
      EXPECT_EQ(cube.now[here.front()], cube.x[there.front()]);
      EXPECT_EQ(cube.now[here.back()], cube.x[there.back()]);
    }
  }
}

TEST(RemesherInSpace, DrawnOutFacesAreDividedAndMaterialSidesStay) {
  RemeshedCube cube(CellShape::tet10, 2.5);
  EXPECT_GT(cube.plan->largest_side(cube.x, State()), 2.0);
  const Remesher again(*cube.anew, cube.after, RemeshingParameters(), cube.deck.root());
  EXPECT_LT(again.largest_side(cube.now, State()), 1.6);
  EXPECT_GT(cube.after.surfaces().surfaces().faces.size(), 1.5 * cube.boundary.surfaces().surfaces().faces.size());
  RemeshedCube held(CellShape::tet10, 2.5,
                    "<Parameter name=\"material sides\" type=\"Array(string)\" value=\"{left, right}\"/>");
  std::multiset<std::multiset<Point>> before, after;  // faces by their nodes' places
  const auto faces_of = [](const GhostedMesh& mesh, const Positions& x, auto& to) {
    for (const auto& side : mesh.boundary()) {
      if (!side.sets.count("left") && !side.sets.count("right")) continue;
      std::multiset<Point> places;
      for (int node : side.nodes) places.insert(x[node]);
      to.insert(places);
    }
  };
  faces_of(held.whole, held.x, before);
  faces_of(*held.anew, held.now, after);
  EXPECT_FALSE(before.empty());
  EXPECT_EQ(before, after);
}

/// The cube has a roof whose ridge crosses edges in their middle, where elements would fold.
TEST(RemesherInSpace, ElementsOnARidgeAreSound) {
  RemeshedCube cube(CellShape::tet10, 0.8, "", 1.9);
  EXPECT_GT(lowest_quality(*cube.anew, cube.now), 0.15);
  const double was = volume(cube.whole, cube.x, points_of(*cube.mesh, 5));
  EXPECT_NEAR(volume(*cube.anew, cube.now, points_of(*cube.next, 5)), was, 0.05 * was);
  const std::set<Point> old(cube.x.begin(), cube.x.end());
  int limited = 0;
  for (const auto& side : cube.anew->side_sets().at("top")) {
    const auto& element = cube.anew->elements()[side.element];
    std::vector<Point> x;
    for (int a : side_nodes(element.shape, side.side)) x.push_back(cube.now[element.nodes[a]]);
    const Point area = cross(x[1] - x[0], x[2] - x[0]);
    for (int k = 0; k < 3; ++k) {
      const Point centre = 0.5 * (x[k] + x[(k + 1) % 3]);
      const double bulge = dot(x[3 + k] - centre, unit(area)) / distance(x[k], x[(k + 1) % 3]);
      if (old.count(x[3 + k])) continue;
      EXPECT_LT(bulge, 0.13);  // 0.1 along the normal of the old surface
      limited += bulge > 0.07;
    }
  }
  EXPECT_GT(limited, 0);
}

/// Counts elements that have two faces on the roof, without peeling and with peeling of all that are not nearly
/// perfect.
TEST(RemesherInSpace, FlatElementsAreTakenOffTheOutside) {
  RemeshedCube cube(CellShape::tet10, 0.8, "", 1.9);
  std::map<double, int> flat;
  for (const double below : {0.0, 0.95}) {
    RemeshingParameters deck;
    deck.quality_below = below;
    const Remesher plan(cube.whole, cube.boundary, deck, cube.deck.root());
    const Mesh next(Tpetra::getDefaultComm(), Geometry::space, plan.make(cube.x, State(), 0.05, nullptr).mesh);
    const GhostedMesh anew(next);
    std::map<int, int> faces;  // by element
    for (const auto& side : anew.side_sets().at("top")) flat[below] += ++faces[side.element] == 2;
    std::size_t named = 0;
    for (const auto& [name, sides] : anew.side_sets()) named += sides.size();
    EXPECT_EQ(named, anew.boundary().size());  // each on one side of the cube
  }
  EXPECT_GT(flat[0.0], flat[0.95]);
}

TEST(RemesherInSpace, LinearFieldsSurviveAtNodesAndPoints) {
  RemeshedCube cube(CellShape::tet10);
  const auto linear = [](const Point& p) { return 3 - 2 * p[0] + 5 * p[1] + p[2]; };
  std::vector<double> at_nodes;  // a linear field, and one that is constant on the boundary
  for (int node = 0; node < cube.whole.num_nodes(); ++node) {
    at_nodes.push_back(linear(cube.x[node]));
    at_nodes.push_back(cube.whole.on_boundary(node) ? 7 : 100);
  }
  const NodalRemap nodal({cube.whole, cube.boundary.paths(), cube.boundary.surfaces().surfaces().faces, cube.x},
                         {*cube.anew, cube.after.paths(), cube.after.surfaces().surfaces().faces, cube.now});
  const auto there = nodal.apply(at_nodes, 2, Support::all_nodes);
  int inside = 0;
  for (int node = 0; node < cube.anew->num_nodes(); ++node) {
    // New nodes of curves are on a smooth curve through the old nodes, slightly off the old faces.
    EXPECT_NEAR(there[2 * node], linear(cube.now[node]), cube.anew->on_boundary(node) ? 2e-4 : 1e-12);
    if (cube.anew->on_boundary(node)) {
      EXPECT_NEAR(there[2 * node + 1], 7, 1e-12);
    } else {
      ++inside;
    }
  }
  EXPECT_GT(inside, 50);
  const SoilBlock old_block = points_of(*cube.mesh), block = points_of(*cube.next);
  const RecoveryPatches patches(cube.whole, old_block);
  std::vector<double> table;  // a linear column, and a constant one
  for (int e : cube.whole.block_elements(0))
    for (int q = 0; q < old_block.points; ++q) {
      table.push_back(linear(Recovery::position(cube.whole.elements()[e], old_block, q, cube.x)));
      table.push_back(7.25);
    }
  std::vector<double> transferred(2 * cube.anew->block_elements(0).size() * block.points);
  const std::vector<StateVariable> variables{{"f", 1, "-"}, {"g", 1, "-"}};
  RecoveryRemap().transfer(
      {{cube.whole, old_block, cube.x}, {*cube.anew, block, cube.now}, patches, variables, 2, table, transferred});
  for (int e : cube.anew->block_elements(0))
    for (int q = 0; q < block.points; ++q) {
      const std::size_t row = 2 * static_cast<std::size_t>(cube.anew->first_row(e, block.points) + q);
      EXPECT_NEAR(transferred[row], linear(Recovery::position(cube.anew->elements()[e], block, q, cube.now)), 1e-11);
      EXPECT_NEAR(transferred[row + 1], 7.25, 1e-12);
    }
}

TEST(WantedSizes, AreWithinBoundsAndGrowNoFasterThanAllowed) {
  const int n = 8;
  const auto mesh = box(CellShape::tri6, n, 0);
  const auto whole = std::make_shared<const GhostedMesh>(*mesh);
  const Positions x = whole->gather(mesh->coordinates());
  std::vector<double> wanted;
  for (const auto& element : whole->elements()) {
    double far = 0;
    for (int a = 0; a < 3; ++a) far = std::max(far, std::hypot(x[element.nodes[a]][0], x[element.nodes[a]][1]));
    wanted.push_back(far < 0.4 ? 0.001 : 5);
  }
  const double growth = 0.2, smallest = 0.02;
  const WantedSizes sizes(whole, x, wanted, {smallest, 0.1, growth});
  EXPECT_NEAR(sizes({0, 0}), smallest, 1e-15);
  EXPECT_NEAR(sizes({1, 1}), 0.1, 1e-15);
  // on the bottom, the vertex at 3/8 has two small elements and a large one: (0.001^2 5)^(1/3) = 0.017 is below the
  // bound
  for (double at : {0.375, 0.4375, 0.5}) EXPECT_NEAR(sizes({at, 0}), smallest + growth * (at - 0.375), 1e-12) << at;
  EXPECT_NEAR(sizes({-0.1, -0.1}), smallest, 1e-15);  // outside
  EXPECT_NEAR(sizes.largest_ratio(), std::sqrt(2 / std::sqrt(3.0)) / n / smallest, 1e-12);
}

TEST(Remesher, AdaptiveSizesAreThoseOfTheErrorOnTheBoundaryAndInside) {
  Remeshed was(CellShape::tri6, "");
  RemeshingParameters deck;
  deck.size = RemeshingParameters::Size::adaptive;
  deck.smallest_size = 0.01;
  deck.largest_size = 1;
  const Remesher plan(was.whole, was.boundary, deck, was.deck.root());
  for (double size : {0.05, 0.25}) {
    const WantedSizes sizes(std::make_shared<const GhostedMesh>(*was.mesh), was.x,
                            std::vector<double>(was.whole.elements().size(), size), {0.01, 1, 0.3});
    const RemeshedMesh made = plan.make(was.x, State(), 0.2, &sizes);
    for (const MeshPath& path : made.paths) EXPECT_EQ(path.num_vertices() - 1, std::lround(1 / size));
    const double elements = static_cast<double>(made.mesh.blocks[0].nodes.size()) / 6;
    EXPECT_NEAR(elements, 4 / std::sqrt(3.0) / (size * size), 0.2 * elements);
  }
}

}  // namespace
}  // namespace mudline
