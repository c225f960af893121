#include <gtest/gtest.h>

#include "discretisation/mesh_quality.hpp"
#include "discretisation/tests/mesh_fixture.hpp"

namespace mudline {
namespace {

using namespace mesh_test;

TEST(MeshQuality, SquaresTrianglesAndFolds) {
  const auto squares = make(box("quad9", 4, 2));
  MeshQuality quality = mesh_quality(*squares, squares->coordinates());
  EXPECT_NEAR(quality.lowest, 1, 1e-14);
  EXPECT_EQ(quality.poor, 0);
  const auto halves = make(box("tri6", 4, 2));
  EXPECT_NEAR(mesh_quality(*halves, halves->coordinates()).lowest, std::sqrt(0.5) / std::sqrt(0.75), 1e-14);

  // squeezed to a tenth in one direction: squares become rectangles, whose corners are still right
  const auto& x = squares->coordinates();
  for (int node = 0; node < squares->num_nodes(); ++node) x(node, 0) *= 0.1;
  EXPECT_NEAR(mesh_quality(*squares, x).lowest, 1, 1e-13);

  // the corner at the upper right of the lower left square goes beyond the square's centre: a dent
  const auto folded = make(box("quad4", 2, 2));
  const auto& y = folded->coordinates();
  for (int node = 0; node < folded->num_nodes(); ++node)
    if (std::abs(y(node, 0) - 1) < 1e-9 && std::abs(y(node, 1) - 0.5) < 1e-9) y(node, 0) = 0.2, y(node, 1) = 0.1;
  quality = mesh_quality(*folded, y);
  EXPECT_LT(quality.lowest, 0);
  EXPECT_EQ(quality.folded, 1);
  EXPECT_NEAR(quality.place[0], 0.25 * (0 + 1 + 0.2 + 0), 1e-12);
  EXPECT_NEAR(quality.place[1], 0.25 * (0 + 0 + 0.1 + 0.5), 1e-12);
}

TEST(MeshQuality, NotANumberCountsAsFolded) {
  const auto mesh = make(box("quad4", 2, 1));
  mesh->coordinates()(0, 0) = std::nan("");
  EXPECT_GE(mesh_quality(*mesh, mesh->coordinates()).folded, 1);
}

}  // namespace
}  // namespace mudline
