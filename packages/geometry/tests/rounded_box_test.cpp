#include "geometry/rounded_box.hpp"

#include <cmath>

#include "core/pi.hpp"
#include "geometry/tests/surface_fixture.hpp"

namespace mudline {
namespace {

TEST(RoundedBox, SidesEdgesAndCorners) {
  const double r = 0.1;
  const RoundedBox box({2, 1, 0.4}, r);
  const SurfaceProjection side = box.closest({0.3, 0.2, 0.5});
  EXPECT_NEAR(side.gap, 0.3, 1e-15);
  EXPECT_EQ(side.normal, (Point{0, 0, 1}));
  EXPECT_EQ(side.turning[0][0], 0);
  EXPECT_EQ(side.turning[1][1], 0);
  // 0.3 and 0.4 m beyond the core of 1.8 m and 0.8 m
  const SurfaceProjection edge = box.closest({-1.2, 0.8, 0.05});
  EXPECT_NEAR(edge.gap, 0.4, 1e-15);
  EXPECT_NEAR(edge.normal[0], -0.6, 1e-15);
  EXPECT_NEAR(edge.normal[1], 0.8, 1e-15);
  EXPECT_NEAR(edge.turning[0][0], 0.64 / 0.5, 1e-14);
  EXPECT_NEAR(edge.turning[0][1], 0.48 / 0.5, 1e-14);
  EXPECT_NEAR(edge.turning[2][2], 0, 1e-15);
  // on the surface of a corner: both principal curvatures are those of the fillet
  const double d = r / std::sqrt(3.0);
  const SurfaceProjection corner = box.closest({0.9 + d, 0.4 + d, -0.1 - d});
  EXPECT_NEAR(corner.gap, 0, 1e-15);
  EXPECT_NEAR(corner.turning[0][0] + corner.turning[1][1] + corner.turning[2][2], 2 / r, 1e-11);
  const SurfaceProjection inside = box.closest({0.5, 0.1, -0.05});
  EXPECT_NEAR(inside.gap, -0.15, 1e-15);
  EXPECT_EQ(inside.normal[2], -1);
  EXPECT_EQ(box.closest({0, 0, 0}).gap, -0.2);
}

TEST(RoundedBox, Derivatives) {
  for (const double r : {0.0, 0.05, 0.2}) {
    const DerivativeErrors errors(RoundedBox({2, 1, 0.4}, r), {{-1.3, -0.8, -0.5}, {1.3, 0.8, 0.5}}, 1e-6, 0.01, 2000);
    EXPECT_GT(errors.compared, 1900) << r;
    EXPECT_LT(errors.normal, 1e-6) << r;
    EXPECT_LT(errors.turning, 1e-4) << r;
    EXPECT_EQ(errors.symmetry, 0) << r;
    EXPECT_LT(errors.along, 1e-11) << r;
    EXPECT_LT(errors.projection, 1e-15) << r;
  }
}

TEST(RoundedBox, SharpEdges) {
  const RoundedBox box({2, 1, 0.5}, 0);
  const SurfaceProjection fan = box.closest({1.3, 0.9, 0});
  EXPECT_NEAR(fan.gap, 0.5, 1e-15);
  EXPECT_NEAR(fan.normal[0], 0.6, 1e-15);
  EXPECT_NEAR(fan.turning[1][1], 0.36 / 0.5, 1e-14);
  const SurfaceProjection edge = box.closest({1, -0.5, 0.1});
  EXPECT_EQ(edge.gap, 0);
  EXPECT_NEAR(edge.normal[0], std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(edge.normal[1], -std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(box.closest({1, 0.5, -0.25}).normal[2], -std::sqrt(1.0 / 3), 1e-15);
  EXPECT_EQ(box.closest({0.2, 0.5, 0.1}).normal, (Point{0, 1, 0}));
  EXPECT_EQ(box.triangles(1e-3).facets.size(), 12u);
}

TEST(RoundedBox, ASphereIsABoxOfFilletsOnly) {
  const RoundedBox ball({1, 1, 1}, 0.5);
  const SurfaceProjection projection = ball.closest({0.3, -0.4, 1.2});
  EXPECT_NEAR(projection.gap, 0.8, 1e-15);
  EXPECT_NEAR(projection.turning[0][0], (1 - 0.09 / 1.69) / 1.3, 1e-14);
  EXPECT_NEAR(ball.moments().volume, pi / 6, 1e-14);
  EXPECT_NEAR(ball.moments().inertia()[1][1], pi / 6 * 0.1, 1e-14);
}

TEST(RoundedBox, MomentsAndTriangles) {
  const RoundedBox sharp({2, 1, 0.4}, 0), box({2, 1, 0.4}, 0.15);
  EXPECT_NEAR(sharp.moments().volume, 0.8, 1e-15);
  EXPECT_NEAR(sharp.moments().inertia()[2][2], 0.8 * 5 / 12, 1e-15);
  const SurfaceTriangles drawn = box.triangles(1e-5);
  EXPECT_NO_THROW(closed_edges(drawn));
  SolidMoments facets;
  for (std::size_t f = 0; f < drawn.facets.size(); ++f)
    for (int k = 0; k < 3; ++k)
      facets.add_side(0.5 * (drawn.points[drawn.facets[f][k]] + drawn.points[drawn.facets[f][(k + 1) % 3]]),
                      1.0 / 6 * drawn.area_vector(f));
  EXPECT_NEAR(facets.volume, box.moments().volume, 1e-4);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(facets.inertia()[i][i], box.moments().inertia()[i][i], 1e-4);
  for (const auto& facet : drawn.facets) {
    Point centre{};
    for (const int point : facet) centre += 1.0 / 3 * drawn.points[point];
    EXPECT_LE(std::abs(box.closest(centre).gap), 1e-5);
  }
}

}  // namespace
}  // namespace mudline
