// Plane meshes around bodies: areas, places on the contour, sizes, and what is refused.
#ifdef MUDLINE_HAVE_GMSH
#include "ale/penetration_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "bodies/tests/rigid_body_deck.hpp"
#include "core/pi.hpp"
#include "core/tests/input_error.hpp"
#include "discretisation/shapes.hpp"

namespace mudline {
namespace {

constexpr double width = 3, depth = 4;

std::string sharp_cone() {
  return text_parameter("type", "cone") + number_parameter("diameter", 0.5) + number_parameter("apex angle [deg]", 60) +
         number_parameter("shaft length", 2);
}

std::string pile() {
  return text_parameter("type", "flat pile") + number_parameter("diameter", 0.5) +
         number_parameter("corner radius", 0.1) + number_parameter("shaft length", 2);
}

struct Soil {
  explicit Soil(const std::string& contour, double tip, const std::string& more = "",
                const std::string& geometry = "axisymmetric")
      : body(section_xml("mesh", text_parameter("type", "penetration") + text_parameter("body", "b") +
                                     text_parameter("geometry", geometry) + number_parameter("width", width) +
                                     number_parameter("depth", depth) + number_parameter("size near body", 0.05) +
                                     more) +
             body_xml("b", contour, text_parameter("type", "held"), "0, " + std::to_string(tip))) {
    Registry<MeshSource> sources("mesh");
    sources.add<PenetrationMesh>("penetration", "");
    MeshRecipe recipe(sources, body.deck.root().section("mesh"), {});
    dynamic_cast<PenetrationMesh&>(recipe.source())
        .read_body(body.deck.root().section("bodies"), {body.contours, body.surfaces, body.motions});
    mesh = recipe.make();
  }

  /// Nodes of a side set, with those in the middle of sides.
  std::set<long long> nodes_of(const std::string& set) const {
    std::set<long long> nodes;
    for (const GlobalMesh::Side& side : mesh.side_sets.at(set)) {
      const GlobalMesh::Block& block = mesh.blocks[side.block];
      for (int local : side_nodes(block.shape, side.side))
        nodes.insert(block.nodes[side.element * num_nodes(block.shape) + local]);
    }
    return nodes;
  }
  /// Largest distance of a set's nodes from the body's contour.
  double off_contour(const std::string& set) {
    const auto b = body.body("b", Geometry::axisymmetric);
    double most = 0;
    for (long long node : nodes_of(set)) {
      const Point& x = mesh.coordinates[node];
      most = std::max(most, std::abs(b->contour().closest({x[0], x[1] - b->initial_position()[1]}).gap));
    }
    return most;
  }
  /// With the sides' parabolas through their mid-side nodes.
  double area() const {
    double sum = 0;
    for (const GlobalMesh::Block& block : mesh.blocks) {
      const int nodes = num_nodes(block.shape);
      for (std::size_t e = 0; e < block.nodes.size(); e += nodes) {
        const auto at = [&](int local) { return mesh.coordinates[block.nodes[e + local]]; };
        const auto cross = [](const Point& a, const Point& b, const Point& c) {
          return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        };
        sum += 0.5 * cross(at(0), at(1), at(2));
        for (int k = 0; k < 3 && nodes == 6; ++k) sum -= 2.0 / 3 * cross(at(k), at((k + 1) % 3), at(3 + k));
      }
    }
    return sum;
  }
  /// Smallest and largest length of the sides of a set.
  std::pair<double, double> sides(const std::string& set) const {
    double low = 1e300, high = 0;
    for (const GlobalMesh::Side& side : mesh.side_sets.at(set)) {
      const GlobalMesh::Block& block = mesh.blocks[side.block];
      const std::vector<int>& local = side_nodes(block.shape, side.side);
      const Point &a = mesh.coordinates[block.nodes[side.element * num_nodes(block.shape) + local[0]]],
                  &b = mesh.coordinates[block.nodes[side.element * num_nodes(block.shape) + local[1]]];
      low = std::min(low, std::hypot(b[0] - a[0], b[1] - a[1]));
      high = std::max(high, std::hypot(b[0] - a[0], b[1] - a[1]));
    }
    return {low, high};
  }

  BodyDeck body;
  GlobalMesh mesh;
};

TEST(PenetrationMesh, ConeInTheGround) {
  Soil soil(sharp_cone(), -1);
  const double cone = 0.25 / std::tan(pi / 6);  // height of the cone
  EXPECT_NEAR(soil.area(), width * depth - 0.25 * (1 - cone) - 0.5 * 0.25 * cone, 1e-12);
  EXPECT_LT(soil.off_contour("hole"), 1e-12);
  const auto [low, high] = soil.sides("hole");
  EXPECT_GT(low, 0.04);
  EXPECT_LT(high, 0.06);
  EXPECT_LT(soil.sides("base").second, 0.55);  // an eighth of the width, and what dividing adds
  EXPECT_EQ(soil.mesh.side_sets.at("surface").size(),
            soil.mesh.side_sets.at("hole").size() + soil.mesh.side_sets.at("seabed").size());
  for (long long node : soil.nodes_of("axis")) EXPECT_EQ(soil.mesh.coordinates[node][0], 0);
  for (long long node : soil.nodes_of("seabed")) EXPECT_EQ(soil.mesh.coordinates[node][1], 0);
}

TEST(PenetrationMesh, RoundEdgeInTheGround) {
  for (const char* order : {"1", "2"}) {
    Soil soil(pile(), -0.5, "<Parameter name=\"order\" type=\"int\" value=\"" + std::string(order) + "\"/>\n");
    // mid-side nodes are on the arc, too
    EXPECT_LT(soil.off_contour("hole"), 1e-12);
    EXPECT_EQ(num_nodes(soil.mesh.blocks.front().shape), order[0] == '1' ? 3 : 6);
    EXPECT_NEAR(soil.area(), width * depth - (0.25 * 0.5 - (1 - pi / 4) * 0.01), order[0] == '1' ? 4e-4 : 2e-6);
  }
}

TEST(PenetrationMesh, BodyOnTheMudline) {
  for (const double above : {0.0, 0.2}) {
    Soil soil(pile(), above);
    EXPECT_NEAR(soil.area(), width * depth, 1e-12);
    EXPECT_EQ(soil.mesh.side_sets.count("hole"), 0u);
    // the surface under the body becomes the wall of its hole, whose upper end is a vertex beside the body's edge
    EXPECT_NEAR(soil.sides("surface").first, 0.05, 0.01);
    double lip = 0;
    for (long long node : soil.nodes_of("seabed"))
      if (const double x = soil.mesh.coordinates[node][0]; std::abs(x - 1.04 * 0.25) < std::abs(lip - 1.04 * 0.25))
        lip = x;
    EXPECT_NEAR(lip, 1.04 * 0.25, 1e-12);
  }
}

/// Number of elements at a place.
int elements_at(const GlobalMesh& mesh, const Point& place) {
  int count = 0;
  for (const GlobalMesh::Block& block : mesh.blocks)
    for (long long node : block.nodes) {
      const Point& x = mesh.coordinates[node];
      count += std::hypot(x[0] - place[0], x[1] - place[1]) < 1e-9 ? 1 : 0;
    }
  return count;
}

TEST(PenetrationMesh, SeveralElementsAtTheCornerUnderABody) {
  for (const double growth : {0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 0.8})
    EXPECT_GE(elements_at(Soil(pile(), 0, number_parameter("growth", growth)).mesh, {0, 0}), 2) << growth;
}

TEST(PenetrationMesh, BuriedBody) {
  Soil soil(text_parameter("type", "cylinder") + number_parameter("diameter", 1), -2.5, "", "plane strain");
  EXPECT_NEAR(soil.area(), width * depth - pi / 8, 2e-5);
  EXPECT_LT(soil.off_contour("hole"), 1e-12);
  EXPECT_EQ(elements_at(soil.mesh, {0, 0}) > 0, true) << "the mudline reaches the axis";
  for (long long node : soil.nodes_of("axis")) {
    const Point& x = soil.mesh.coordinates[node];
    EXPECT_EQ(x[0], 0);
    EXPECT_TRUE(x[1] > -1.5 - 1e-12 || x[1] < -2.5 + 1e-12) << x[1];
  }
}

TEST(PenetrationMesh, Refused) {
  const auto refuse = [](const std::string& contour, double tip, const std::string& more, const std::string& expected) {
    const std::string message = input_error([&] { Soil(contour, tip, more); });
    EXPECT_NE(message.find(expected), std::string::npos) << message;
  };
  refuse(pile(), -2.5, "",
         "the contour of body 'b' ends in the ground, off the axis: it must reach the mudline, at 0 m, or the axis");
  refuse(sharp_cone(), -1, number_parameter("largest size", 0.01),
         "size near body: 0.05 is more than the largest size, 0.01");
  EXPECT_NE(input_error([] {
              Soil(pile() + text_parameter("extent", "full"), -1, "", "plane strain");
            }).find("a penetration mesh is for bodies with a half contour"),
            std::string::npos);
  EXPECT_NE(input_error([] {
              Soil(pile() + text_parameter("extent", "full"), -1);
            }).find("an axisymmetric body has a half contour, not a full one"),
            std::string::npos);
  refuse(text_parameter("type", "flat pile") + number_parameter("diameter", 7) + number_parameter("shaft length", 9),
         -1, "", "width: body 'b' reaches to 3.5 m in the ground");
  refuse(text_parameter("type", "flat pile") + number_parameter("diameter", 1) + number_parameter("shaft length", 9),
         -5, "", "depth: body 'b' reaches to 5 m in the ground");
}

}  // namespace
}  // namespace mudline
#endif
