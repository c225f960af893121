#include <gtest/gtest.h>

#include <set>

#include "discretisation/mesh_quality.hpp"
#include "discretisation/mesh_topology.hpp"
#include "discretisation/sweep.hpp"
#include "discretisation/tests/mesh_fixture.hpp"

namespace mudline {
namespace {

using namespace mesh_test;

constexpr double pi = 3.14159265358979323846;

std::string plane(const std::string& entries) {
  return "<ParameterList name=\"plane\">" + entries + "</ParameterList>";
}

std::string sweep(const std::string& type, const std::string& entries, const std::string& mesh) {
  return parameter("type", "string", type) + parameter("geometry", "string", "three-dimensional") + entries +
         plane(mesh);
}

std::string extruded(const std::string& mesh, const std::string& more = "") {
  return sweep("extruded", parameter("length", "double", "3") + parameter("layers", "int", "4") + more, mesh);
}

std::string revolved(double angle, int layers, const std::string& mesh, const std::string& more = "") {
  return sweep(
      "revolved",
      parameter("angle", "double", std::to_string(angle)) + parameter("layers", "int", std::to_string(layers)) + more,
      mesh);
}

/// A ring with radii 1 to 3 and heights 0 to 1.
std::string ring(const std::string& cell, const std::string& more = "") {
  return parameter("type", "string", "box") + parameter("cell", "string", cell) +
         parameter("cells", "Array(int)", "{4, 2}") + parameter("lower", "Array(double)", "{1, 0}") +
         parameter("upper", "Array(double)", "{3, 1}") + more;
}

const char* const cells[] = {"quad9", "tri6", "quad4", "tri3"};
std::string become(const std::string& cells) { return parameter("triangles become", "string", cells); }
const std::string wedges = become("wedges"), tetrahedra = become("tetrahedra");

void expect_sides(const Mesh& mesh, const std::map<std::string, std::array<double, 4>>& expected, double tolerance) {
  for (const auto& [set, values] : expected) {
    ASSERT_TRUE(mesh.has_side_set(set)) << set;
    const auto sum = side_integral(mesh, set);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(sum[i], values[i], tolerance) << set << " " << i;
    const Section section = mesh_section(parameter("side", "string", set));
    EXPECT_NO_THROW(require_boundary(mesh, section, "side", set));
  }
}

TEST(ExtrudedMesh, PlanDrawnUpwards) {
  for (const char* cell : cells) {
    const auto mesh = make(extruded(box(cell, 4, 3, parameter("distortion", "double", "0.2")), tetrahedra));
    const bool simplex = cell[0] == 't';
    EXPECT_EQ(mesh->dimension(), 3);
    EXPECT_EQ(num_corners(mesh->blocks()[0].shape), simplex ? 4 : 8);
    EXPECT_EQ(order(mesh->blocks()[0].shape), cell[0] == 'q' ? (cell[4] == '9' ? 2 : 1) : (cell[3] == '6' ? 2 : 1));
    EXPECT_EQ(mesh->num_global_elements(), 4 * 12 * (simplex ? 6 : 1)) << cell;
    EXPECT_NEAR(area(*mesh), 6, 1e-12) << cell;
    EXPECT_LT(gradient_error(*mesh), 1e-12) << cell;
    expect_sides(*mesh,
                 {{"left", {3, -3, 0, 0}},
                  {"right", {3, 3, 0, 0}},
                  {"bottom", {6, 0, -6, 0}},
                  {"top", {6, 0, 6, 0}},
                  {"start", {2, 0, 0, -2}},
                  {"end", {2, 0, 0, 2}}},
                 1e-12);
  }
}

TEST(ExtrudedMesh, TrianglesBecomeWedges) {
  for (const char* along : {"z", "y"})
    for (const char* cell : {"tri6", "tri3"}) {
      const auto mesh = make(extruded(box(cell, 4, 3, parameter("distortion", "double", "0.2")),
                                      wedges + parameter("along", "string", along)));
      EXPECT_EQ(mesh->blocks()[0].shape, cell[3] == '6' ? CellShape::wedge15 : CellShape::wedge6);
      EXPECT_EQ(mesh->num_global_elements(), 4 * 12 * 2) << cell;
      EXPECT_NEAR(area(*mesh), 6, 1e-12) << cell;
      EXPECT_LT(gradient_error(*mesh), 1e-12) << cell;
      EXPECT_GT(mesh_quality(*mesh, mesh->coordinates()).lowest, 0.3);
      const int up = along[0] == 'z' ? 1 : 2, across = 3 - up;
      std::map<std::string, std::array<double, 4>> sides{{"left", {3, -3, 0, 0}}, {"right", {3, 3, 0, 0}}};
      sides["bottom"][0] = sides["top"][0] = 6;
      sides["bottom"][1 + up] = -6;
      sides["top"][1 + up] = 6;
      sides["start"][0] = sides["end"][0] = 2;
      sides["start"][1 + across] = -2;
      sides["end"][1 + across] = 2;
      expect_sides(*mesh, sides, 1e-12);
    }
}

TEST(ExtrudedMesh, SectionDrawnAcross) {
  for (const char* cell : cells) {
    const auto mesh =
        make(extruded(box(cell, 4, 3), parameter("along", "string", "y") + parameter("from", "double", "-1")));
    EXPECT_EQ(mesh->bounds().low, (Point{0, -1, 0}));
    EXPECT_EQ(mesh->bounds().high, (Point{2, 2, 1})) << "the plane's y is z";
    EXPECT_NEAR(area(*mesh), 6, 1e-12) << cell;
    expect_sides(*mesh,
                 {{"left", {3, -3, 0, 0}}, {"top", {6, 0, 0, 6}}, {"start", {2, 0, -2, 0}}, {"end", {2, 0, 2, 0}}},
                 1e-12);
  }
}

TEST(ExtrudedMesh, GradingRegionsAndOneLayer) {
  const auto mesh = make(extruded(box("quad4", 1, 4,
                                      parameter("layer tops", "Array(double)", "{0.25}") +
                                          parameter("layer regions", "Array(string)", "{sand, clay}")),
                                  parameter("grading", "double", "8")));
  EXPECT_NEAR(area(*mesh, "sand"), 1.5, 1e-12);
  std::set<double> heights;
  for (int n = 0; n < mesh->num_nodes(); ++n) heights.insert(mesh->coordinates()(n, 2));
  ASSERT_EQ(heights.size(), 5u);
  const std::vector<double> z(heights.begin(), heights.end());
  EXPECT_NEAR((z[4] - z[3]) / (z[1] - z[0]), 8, 1e-12);
  const auto single =
      make(sweep("extruded", parameter("length", "double", "1") + parameter("layers", "int", "1") + tetrahedra,
                 box("tri3", 1, 1)));
  EXPECT_EQ(single->num_global_elements(), 6);
  EXPECT_NEAR(area(*single), 2, 1e-13);
}

TEST(RevolvedMesh, QuarterHalfAndWholeRing) {
  const double exact = pi * (9 - 1);
  for (const auto& [angle, layers] : {std::pair{90., 4}, {180., 8}, {360., 16}})
    for (const char* cell : cells) {
      const bool linear = cell[0] == 'q' ? cell[4] == '4' : cell[3] == '3';
      const double share = angle / 360, tolerance = linear ? 0.04 * exact : 2e-3;
      const auto mesh = make(revolved(angle, layers, ring(cell), tetrahedra));
      EXPECT_NEAR(area(*mesh), share * exact, tolerance) << cell << " " << angle;
      EXPECT_LT(gradient_error(*mesh), 1e-10) << cell;
      EXPECT_EQ(mesh_parts(*mesh).places.size(), 1u);
      EXPECT_NEAR(side_integral(*mesh, "top")[3], share * exact, tolerance);
      EXPECT_NEAR(side_integral(*mesh, "right")[0], share * 6 * pi, tolerance);
      EXPECT_NEAR(side_integral(*mesh, "left")[0], share * 2 * pi, tolerance);
      EXPECT_EQ(mesh->has_side_set("start"), angle < 360);
      if (angle == 90) expect_sides(*mesh, {{"start", {2, 0, -2, 0}}, {"end", {2, -2, 0, 0}}}, 1e-12);
      if (angle == 180) expect_sides(*mesh, {{"start", {2, 0, -2, 0}}, {"end", {2, 0, -2, 0}}}, 1e-12);
      // mid-side nodes lie on circles too
      for (int node : mesh->nodes_of_set("right"))
        EXPECT_NEAR(std::hypot(mesh->coordinates()(node, 0), mesh->coordinates()(node, 1)), 3, 1e-12);
      if (angle == 360)
        for (int i = 0; i < 2; ++i) {
          EXPECT_NEAR(side_integral(*mesh, "right")[1 + i], 0, 1e-12);
        }
    }
}

TEST(RevolvedMesh, TrianglesOfARingBecomeWedges) {
  const double exact = pi * (9 - 1);
  for (const auto& [angle, layers] : {std::pair{90., 4}, {360., 16}}) {
    const auto cut = make(revolved(angle, layers, ring("tri6"), tetrahedra)),
               mesh = make(revolved(angle, layers, ring("tri6"), wedges));
    EXPECT_EQ(mesh->blocks()[0].shape, CellShape::wedge15);
    EXPECT_EQ(mesh->num_global_elements(), cut->num_global_elements() / 3);
    EXPECT_LT(mesh->num_global_nodes(), 0.75 * cut->num_global_nodes());
    EXPECT_NEAR(area(*mesh), angle / 360 * exact, 2e-3);
    EXPECT_LT(gradient_error(*mesh), 1e-10);
    EXPECT_EQ(mesh_parts(*mesh).places.size(), 1u);
    EXPECT_NEAR(side_integral(*mesh, "right")[0], angle / 360 * 6 * pi, 2e-3);
    for (int node : mesh->nodes_of_set("right"))
      EXPECT_NEAR(std::hypot(mesh->coordinates()(node, 0), mesh->coordinates()(node, 1)), 3, 1e-12);
    if (angle == 90) expect_sides(*mesh, {{"start", {2, 0, -2, 0}}, {"end", {2, -2, 0, 0}}}, 1e-12);
  }
}

/// A disc of radius 2 with heights 0 to 1: the left side of the plane is the axis.
TEST(RevolvedMesh, QuadrilateralsAtTheAxisBecomeWedges) {
  for (const char* cell : {"quad9", "quad4"})
    for (const auto& [angle, layers] : {std::pair{90., 4}, {180., 8}, {360., 16}}) {
      const bool linear = cell[4] == '4';
      const double exact = angle / 360 * pi * 4, tolerance = linear ? 0.04 * exact : 1e-3 * exact;
      const auto mesh = make(revolved(angle, layers, box(cell, 4, 3)));
      EXPECT_EQ(mesh->num_global_elements(), 12 * layers);
      ASSERT_EQ(mesh->blocks().size(), 2u);
      EXPECT_EQ(mesh->blocks()[0].shape, linear ? CellShape::wedge6 : CellShape::wedge18);
      EXPECT_EQ(mesh->blocks()[1].shape, linear ? CellShape::hex8 : CellShape::hex27);
      EXPECT_NEAR(area(*mesh), exact, tolerance) << cell << " " << angle;
      EXPECT_NEAR(side_integral(*mesh, "bottom")[3], -exact, tolerance) << cell << " " << angle;
      EXPECT_NEAR(side_integral(*mesh, "right")[0], angle / 360 * 4 * pi, linear ? 0.1 : 2e-3);
      EXPECT_LT(gradient_error(*mesh), 1e-9);
      EXPECT_GT(mesh_quality(*mesh, mesh->coordinates()).lowest, 0.3);
      EXPECT_EQ(mesh_parts(*mesh).places.size(), 1u);
      EXPECT_FALSE(mesh->has_side_set("left"));
      EXPECT_EQ(mesh->node_sets().at("left").size(), linear ? 4u : 7u);
      if (angle == 90) expect_sides(*mesh, {{"start", {2, 0, -2, 0}}, {"end", {2, -2, 0, 0}}}, 1e-12);
    }
}

TEST(RevolvedMesh, AutomaticTakesWedgesWhereNoTriangleTouchesTheAxisWithOneCornerOnly) {
  EXPECT_EQ(make(revolved(90, 4, ring("tri6")))->blocks()[0].shape, CellShape::wedge15);
  EXPECT_EQ(make(revolved(90, 4, box("tri6", 2, 2), become("automatic")))->blocks()[0].shape, CellShape::tet10);
  // one cell cut along its diagonal: a triangle that stands on the axis, and one that touches it
  EXPECT_CONTAINS(input_error([&] { make(revolved(90, 2, box("tri6", 1, 1), wedges)); }),
                  "mesh/plane: its triangle with a corner at (0, 0) touches the axis with that corner only, where a "
                  "wedge would become a pyramid; let 'triangles become' tetrahedra");
}

/// A disc of radius 2 with heights 0 to 1: the left side of the plane is the axis.
TEST(RevolvedMesh, TrianglesCollapseAtTheAxis) {
  for (const char* cell : {"tri6", "tri3"})
    for (const auto& [angle, layers] : {std::pair{90., 4}, {180., 8}, {360., 16}}) {
      const bool linear = cell[3] == '3';
      const double exact = angle / 360 * pi * 4, tolerance = linear ? 0.04 * exact : 1e-3 * exact;
      const auto mesh = make(revolved(angle, layers, box(cell, 4, 3)));
      EXPECT_NEAR(area(*mesh), exact, tolerance) << cell << " " << angle;
      EXPECT_NEAR(side_integral(*mesh, "bottom")[3], -exact, tolerance) << cell << " " << angle;
      EXPECT_LT(gradient_error(*mesh), 1e-9);
      EXPECT_GT(mesh_quality(*mesh, mesh->coordinates()).lowest, 0.02);
      // the axis, the plane's left side, is a line of points
      EXPECT_FALSE(mesh->has_side_set("left"));
      EXPECT_EQ(mesh->node_sets().at("left").size(), linear ? 4u : 7u);
      for (int node : mesh->nodes_of_set("left")) EXPECT_EQ(mesh->coordinates()(node, 0), 0);
      if (angle == 90) expect_sides(*mesh, {{"start", {2, 0, -2, 0}}, {"end", {2, -2, 0, 0}}}, 1e-12);
    }
}

#ifdef MUDLINE_HAVE_GMSH
TEST(RevolvedMesh, OfAGmshModelWithPointsAndCurvedSides) {
  const auto mesh = make(revolved(180, 8, gmsh("cone.geo")));
  const double sphere = 2.0 / 3 * pi * 0.125;  // half a sphere cut out at the axis; half a turn cuts half of it
  EXPECT_NEAR(area(*mesh), pi * 9 - sphere / 2, 3e-2);
  EXPECT_EQ(mesh->regions(), (std::vector<std::string>{"sand", "clay"}));
  EXPECT_NEAR(side_integral(*mesh, "notch")[0], pi * 0.25, 3e-3);
  EXPECT_NEAR(side_integral(*mesh, "notch")[3], pi * 0.125, 3e-3);
  EXPECT_EQ(mesh->nodes_of_set("tip").size(), 1u) << "on the axis";
  EXPECT_EQ(make(extruded(gmsh("cone.geo")))->nodes_of_set("tip").size(), 9u) << "the line that the point leaves";
}
#endif

#ifdef MUDLINE_HAVE_GMSH
TEST(SweptMesh, TrianglesBesideQuadrilateralsBecomeWedgesThatFit) {
  const std::string upright = parameter("along", "string", "y");
  for (const auto& [entries, tolerance] : {std::pair{extruded(gmsh("mixed_plane.geo"), upright), 1e-12},
                                           {revolved(90, 4, gmsh("mixed_plane.geo")), 2e-2}}) {
    const auto mesh = make(entries);
    std::set<CellShape> shapes;
    for (const ElementBlock& block : mesh->blocks()) shapes.insert(block.shape);
    EXPECT_EQ(shapes, (std::set<CellShape>{CellShape::hex27, CellShape::wedge18}));
    const bool straight = tolerance < 1e-3;
    // Pappus: areas 1 and 1/2 around 1.5 and 7/3
    EXPECT_NEAR(area(*mesh), straight ? 4.5 : 0.5 * pi * (1.5 + 7.0 / 6), tolerance);
    EXPECT_NEAR(side_integral(*mesh, "base")[3], straight ? -6 : -0.25 * pi * 8, tolerance);
    EXPECT_NEAR(side_integral(*mesh, "start")[2], -1.5, 1e-12) << "quadrilaterals and triangles";
    EXPECT_LT(gradient_error(*mesh), 1e-10);
    EXPECT_EQ(mesh_parts(*mesh).places.size(), 1u);
  }
}
#endif

TEST(SweptMesh, AQuadrilateralMustNotTouchTheAxisWithOneCornerOnly) {
  GlobalMesh plane;
  plane.coordinates = {{0, 0}, {1, -1}, {2, 0}, {1, 1}};
  plane.blocks = {{"soil", CellShape::quad4, {0, 1, 2, 3}}};
  Sweep sweep;
  sweep.fixed = {1, 0, 0, 0};
  sweep.place = [](const Point& x, double layers) { return Point{x[0], x[0] * layers, x[1]}; };
  EXPECT_CONTAINS(input_error([&] { swept(plane, sweep); }),
                  "its quadrilateral with a corner at (0, 0) touches the axis with that corner only, where it would "
                  "collapse; use triangles there");
}

TEST(SweptMesh, Errors) {
  const auto message = [](const std::string& entries) { return input_error([&] { make(entries); }); };
  EXPECT_CONTAINS(message(revolved(90, 2, box("tri6", 2, 2, parameter("lower", "Array(double)", "{-1, 0}")))),
                  "mesh/plane: an axisymmetric mesh needs radii x >= 0");
  EXPECT_CONTAINS(message(revolved(361, 8, ring("quad4"))), "mesh/angle: 361 is out of range");
  EXPECT_CONTAINS(message(revolved(180, 1, ring("quad4"))), "mesh/layers: expected at least 2, given 1");
  EXPECT_CONTAINS(message(revolved(360, 3, ring("quad4"))), "mesh/layers: expected at least 4, given 3");
  const std::string lacking = parameter("type", "string", "extruded") +
                              parameter("geometry", "string", "three-dimensional") +
                              parameter("length", "double", "3") + parameter("layers", "int", "4");
  EXPECT_CONTAINS(message(lacking), "mesh: required section 'plane' is missing");
  EXPECT_CONTAINS(message(lacking + "<ParameterList name=\"plan\"/>"), "mesh/plan: unknown");
  EXPECT_CONTAINS(message(lacking + plane(parameter("type", "string", "bix"))),
                  "mesh/plane/type: unknown plane mesh type 'bix' (did you mean 'box'?)");
  EXPECT_CONTAINS(message(lacking + plane(parameter("type", "string", "extruded"))),
                  "unknown plane mesh type 'extruded'");
  EXPECT_CONTAINS(message(extruded(box("hex8", 2, 2))), "mesh/plane/cell: 'hex8' is a cell of space");
  EXPECT_CONTAINS(message(extruded(box("quad4", 2, 2, parameter("geometry", "string", "axisymmetric")))),
                  "mesh/plane/geometry: belongs to the section 'mesh'");
  EXPECT_CONTAINS(message(extruded(box("quad4", 2, 2, parameter("cracks", "Array(string)", "{top}")))),
                  "mesh/plane/cracks: belongs to the section 'mesh'");
  EXPECT_CONTAINS(
      message(parameter("type", "string", "extruded") + parameter("geometry", "string", "plane strain") +
              parameter("length", "double", "3") + parameter("layers", "int", "4") + plane(box("quad4", 2, 2))),
      "mesh/geometry: an extruded mesh is one of space: give the geometry 'three-dimensional'");
  EXPECT_CONTAINS(message(parameter("type", "string", "revolved") + parameter("angle", "double", "90") +
                          parameter("layers", "int", "4") + plane(ring("quad4"))),
                  "mesh/type: a revolved mesh is one of space: give the geometry 'three-dimensional'");
  EXPECT_CONTAINS(message(extruded(box("quad4", 2, 2), parameter("along", "string", "x"))),
                  "mesh/along: 'x' is not a choice");
  EXPECT_CONTAINS(message(sweep("extruded", parameter("length", "double", "3") + parameter("layers", "int", "100000"),
                                box("quad4", 10, 10))),
                  "mesh/plane: its 100 elements in 100000 layers are more than 5e+06 cells");
}

TEST(SweptMesh, NamesOfTheEndsAreTaken) {
  GlobalMesh mesh;
  mesh.coordinates = {{0, 0}, {1, 0}, {0, 1}};
  mesh.blocks = {{"soil", CellShape::tri3, {0, 1, 2}}};
  mesh.node_sets["end"] = {1};
  Sweep sweep;
  sweep.fixed = {0, 0, 0};
  sweep.place = [](const Point& x, double layers) { return Point{x[0], x[1], layers}; };
  EXPECT_CONTAINS(input_error([&] { swept(mesh, sweep); }), "it has a set called 'end'");
  mesh.node_sets.clear();
  EXPECT_EQ(swept(mesh, sweep).blocks[0].nodes.size(), 12u);
}

}  // namespace
}  // namespace mudline
