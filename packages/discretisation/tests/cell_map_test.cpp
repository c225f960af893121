#include "discretisation/cell_map.hpp"

#include <gtest/gtest.h>

#include "discretisation/shapes.hpp"

namespace mudline {
namespace {

TEST(CellMap, GradientsOfALinearFunctionOnACurvedCell) {
  const double x[6][2] = {{0, 0}, {2, 0.2}, {0.3, 1.5}, {1.1, -0.1}, {1.2, 0.9}, {0.1, 0.8}};
  const double xi[2] = {0.3, 0.25};
  double N[6], dN[12], g[6][2], slope[2] = {0, 0};
  evaluate_shape(CellShape::tri6, xi, N, dN);
  CellMap<2> map;
  map.compute(x, dN);
  map.gradients(dN, g);
  for (int a = 0; a < 6; ++a)
    for (int i = 0; i < 2; ++i) slope[i] += (3 * x[a][0] - 5 * x[a][1]) * g[a][i];
  EXPECT_NEAR(slope[0], 3, 1e-14);
  EXPECT_NEAR(slope[1], -5, 1e-14);
  EXPECT_GT(map.det, 0);
}

TEST(CellMap, TetrahedronInSpace) {
  // corners (0,0,0), (2,0,0), (0,3,0), (1,1,4): six times the volume is 24
  const double x[4][3] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {1, 1, 4}};
  const double dN[12] = {-1, -1, -1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  double g[4][3];
  CellMap<3> map;
  map.compute(x, dN);
  EXPECT_DOUBLE_EQ(map.det, 24);
  map.gradients(dN, g);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double slope = 0;  // gradient of coordinate i
      for (int a = 0; a < 4; ++a) slope += x[a][i] * g[a][j];
      EXPECT_NEAR(slope, i == j ? 1 : 0, 1e-15);
    }
}

TEST(CellMap, FoldedCellHasNoPositiveDeterminant) {
  const double x[3][2] = {{0, 0}, {0, 1}, {1, 0}}, dN[6] = {-1, -1, 1, 0, 0, 1};
  CellMap<2> map;
  map.compute(x, dN);
  EXPECT_DOUBLE_EQ(map.det, -1);
}

}  // namespace
}  // namespace mudline
