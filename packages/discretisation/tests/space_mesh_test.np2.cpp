#include <gtest/gtest.h>
#include <Teuchos_CommHelpers.hpp>

#include <set>

#include "discretisation/mesh_quality.hpp"
#include "discretisation/mesh_topology.hpp"
#include "discretisation/tests/mesh_fixture.hpp"

namespace mudline {
namespace {

using namespace mesh_test;

double sum(double value) {
  double total = 0;
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, 1, &value, &total);
  return total;
}

class SpaceOnTwoRanks : public testing::TestWithParam<const char*> {
 protected:
  std::unique_ptr<Mesh> mesh_ =
      make(box3(GetParam(), 4, 3, 4,
                parameter("distortion", "double", "0.2") + parameter("layer tops", "Array(double)", "{0.75}") +
                    parameter("layer regions", "Array(string)", "{sand, clay}")));
};

TEST_P(SpaceOnTwoRanks, PartsMakeTheWhole) {
  int elements = 0;
  for (const ElementBlock& block : mesh_->blocks()) elements += block.num_elements;
  EXPECT_EQ(sum(elements), mesh_->num_global_elements());
  EXPECT_NEAR(elements, 0.5 * mesh_->num_global_elements(), 0.1 * mesh_->num_global_elements());
  EXPECT_EQ(sum(mesh_->num_owned_nodes()), mesh_->num_global_nodes());
  EXPECT_NEAR(sum(area(*mesh_)), 3, 1e-13);
  EXPECT_NEAR(sum(area(*mesh_, "sand")), 1.5, 0.1) << "its surface is distorted";
  EXPECT_NEAR(sum(side_integral(*mesh_, "top")[3]), 2, 1e-13);
  EXPECT_NEAR(sum(side_integral(*mesh_, "back")[2]), 3, 1e-13);
  EXPECT_LT(gradient_error(*mesh_), 1e-12);
  EXPECT_EQ(mesh_->coordinates().extent(1), 3u);
  EXPECT_EQ(mesh_->bounds().high, (Point{2, 1, 1.5}));
  EXPECT_EQ(mesh_->region_bounds().at("sand").low, (Point{0, 0, 0}));
  EXPECT_EQ(mesh_->region_bounds().at("clay").high, (Point{2, 1, 1.5}));
}

/// The two parts meet near one plane: a partition that counts neighbours across edges only would be ragged.
TEST_P(SpaceOnTwoRanks, TheCutIsSmall) {
  const double ghosts = sum(mesh_->num_nodes() - mesh_->num_owned_nodes());
  const int per_cell = order(mesh_->blocks()[0].shape);
  EXPECT_LT(ghosts, 3.0 * (4 * per_cell + 1) * (3 * per_cell + 1));
}

TEST_P(SpaceOnTwoRanks, QualityPartsAndBoundaries) {
  const MeshQuality quality = mesh_quality(*mesh_, mesh_->coordinates());
  double lowest = 1e300;
  for (const ElementBlock& block : mesh_->blocks())
    for (int e = 0; e < block.num_elements; ++e) lowest = std::min(lowest, map_of(*mesh_, block, e).scaled_jacobian());
  EXPECT_LE(quality.lowest, lowest);
  EXPECT_GT(quality.lowest, 0);
  EXPECT_GT(quality.place[2], 0) << "known to both ranks";
  EXPECT_EQ(mesh_parts(*mesh_).places.size(), 1u);
  const Section section = mesh_section(parameter("side", "string", "top"));
  EXPECT_NO_THROW(require_boundary(*mesh_, section, "side", "top"));
}

INSTANTIATE_TEST_SUITE_P(Cells, SpaceOnTwoRanks, testing::Values("hex27", "tet10", "hex8", "tet4", "wedge15"),
                         [](const auto& info) { return std::string(info.param); });

TEST(SweptOnTwoRanks, PartsMakeTheWhole) {
  const std::string plane = "<ParameterList name=\"plane\">" + box("tri6", 4, 2) + "</ParameterList>";
  const auto mesh =
      make(parameter("type", "string", "revolved") + parameter("geometry", "string", "three-dimensional") +
           parameter("angle", "double", "360") + parameter("layers", "int", "12") + plane);
  EXPECT_NEAR(sum(area(*mesh)), 4 * 3.14159265358979, 2e-2);
  EXPECT_NEAR(sum(side_integral(*mesh, "top")[3]), 4 * 3.14159265358979, 2e-2);
  EXPECT_EQ(sum(mesh->num_owned_nodes()), mesh->num_global_nodes());
  EXPECT_CONTAINS(input_error([&] {
                    make(parameter("type", "string", "extruded") +
                         parameter("geometry", "string", "three-dimensional") + parameter("length", "double", "1") +
                         parameter("layers", "int", "1"));
                  }),
                  "required section 'plane' is missing");
}

TEST(SpaceTopologyOnTwoRanks, InnerSides) {
  GlobalMesh mesh;
  mesh.blocks = {{"soil", CellShape::hex8, {}}};
  for (int i = 0; i < 7; ++i)
    for (const auto& [y, z] : {std::pair{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}})
      mesh.coordinates.push_back({double(i), y, z});
  for (long long e = 0; e < 6; ++e)
    for (const long long c : {0, 4, 5, 1, 3, 7, 6, 2}) mesh.blocks[0].nodes.push_back(4 * e + c);
  mesh.side_sets["wall"] = {{0, 2, 1}, {0, 0, 0}};
  mesh.side_sets["end"] = {{0, 5, 1}};
  const Mesh made(world(), Geometry::space, mesh);
  const Section section = mesh_section(parameter("side", "string", "wall"));
  EXPECT_CONTAINS(input_error([&] { require_boundary(made, section, "side", "wall"); }),
                  "side set 'wall' has a side between two elements, at (3, 0.5, 0.5)");
  EXPECT_NO_THROW(require_boundary(made, section, "side", "end"));
}

}  // namespace
}  // namespace mudline
