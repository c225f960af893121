#include "discretisation/side_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "discretisation/shapes.hpp"

namespace mudline {
namespace {

TEST(SideMap, OfAnArcHasItsLengthAndLooksOutward) {
  // a quarter of the unit circle, counter-clockwise, by its parabola: length pi/2 within the parabola's error
  const double c = std::sqrt(0.5), x[3][2] = {{1, 0}, {0, 1}, {c, c}};
  const QuadratureRule rule = line_quadrature(11);
  double length = 0;
  for (std::size_t q = 0; q < rule.weights.size(); ++q) {
    double N[3], dN[3];
    evaluate_line(3, rule.points[q][0], N, dN);
    SideMap<2> map;
    map.compute(3, N, dN, [&](int a, int i) { return x[a][i]; });
    length += rule.weights[q] * map.stretch;
    EXPECT_GT(map.normal[0] * map.x[0] + map.normal[1] * map.x[1], 0) << "outward";
    EXPECT_NEAR(std::hypot(map.normal[0], map.normal[1]), map.stretch, 1e-15);
  }
  EXPECT_NEAR(length, std::acos(-1.0) / 2, 0.01);
}

TEST(SideMap, OfATiltedFaceInSpaceHasItsAreaAndNormal) {
  // the face z = 1 + x/2 - y/3 over the rectangle 2 x 3, corners counter-clockwise from above, bilinear shapes
  const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const double s = 0.3, t = -0.6;
  double N[4], dN[8], x[4][3];
  for (int a = 0; a < 4; ++a) {
    const double u = corner[a][0], v = corner[a][1];
    N[a] = 0.25 * (1 + u * s) * (1 + v * t);
    dN[2 * a] = 0.25 * u * (1 + v * t);
    dN[2 * a + 1] = 0.25 * (1 + u * s) * v;
    x[a][0] = u;
    x[a][1] = 1.5 * v;
    x[a][2] = 1 + x[a][0] / 2 - x[a][1] / 3;
  }
  SideMap<3> map;
  map.compute(4, N, dN, [&](int a, int i) { return x[a][i]; });
  const double share = 2.0 * 3.0 / 4.0;  // area of the rectangle over that of the reference square
  EXPECT_NEAR(map.normal[0], -0.5 * share, 1e-14);
  EXPECT_NEAR(map.normal[1], share / 3, 1e-14);
  EXPECT_NEAR(map.normal[2], share, 1e-14);
  EXPECT_NEAR(map.stretch, share * std::sqrt(1 + 0.25 + 1.0 / 9), 1e-14);
  EXPECT_NEAR(map.x[2], 1 + s / 2 - 1.5 * t / 3, 1e-14);
}

TEST(SideMap, DualNumbersGiveTheDerivativesOfNormalAndStretch) {
  const double x[3][2] = {{0.1, 0.2}, {1.3, 0.7}, {0.6, 0.9}}, h = 1e-6;
  double N[3], dN[3];
  evaluate_line(3, 0.4, N, dN);
  SideMap<2, Dual<6>> exact;
  exact.compute(3, N, dN, [&](int a, int i) { return Dual<6>(x[a][i], 2 * a + i); });
  for (int k = 0; k < 6; ++k) {
    SideMap<2> above, below;
    above.compute(3, N, dN, [&](int a, int i) { return x[a][i] + (2 * a + i == k ? h : 0); });
    below.compute(3, N, dN, [&](int a, int i) { return x[a][i] - (2 * a + i == k ? h : 0); });
    EXPECT_NEAR(exact.stretch.d[k], (above.stretch - below.stretch) / (2 * h), 1e-9);
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(exact.normal[i].d[k], (above.normal[i] - below.normal[i]) / (2 * h), 1e-9);
      EXPECT_NEAR(exact.x[i].d[k], (above.x[i] - below.x[i]) / (2 * h), 1e-9);
    }
  }
}

}  // namespace
}  // namespace mudline
