#include "geometry/revolved_surface.hpp"

#include <cmath>

#include "core/pi.hpp"
#include "geometry/tests/surface_fixture.hpp"
#include "geometry/triangulated_surface.hpp"

namespace mudline {
namespace {

std::string sphere(double diameter) {
  return text_parameter("type", "sphere") + number_parameter("diameter", diameter);
}

std::string rounded_cone(double tip) {
  return text_parameter("type", "cone") + number_parameter("diameter", 1) + number_parameter("apex angle [deg]", 60) +
         number_parameter("tip radius", tip) + number_parameter("shoulder radius", 0.1);
}

std::string torpedo() {
  return text_parameter("type", "torpedo") + number_parameter("diameter", 1) + number_parameter("length", 12) +
         number_parameter("tip length", 1.5) + number_parameter("tail length", 2) +
         number_parameter("tail diameter", 0.6) + number_parameter("top radius", 0.1);
}

void expect_turning(const SurfaceProjection& projection, const Point& normal, double along, double around,
                    double tolerance) {
  // along: the turning in the plane of the axis and the normal; around: at right angles to both
  const double r = std::hypot(normal[0], normal[1]);
  const Point e = r > 0 ? Point{-normal[1] / r, normal[0] / r, 0} : Point{0, 1, 0}, t = cross(e, normal);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(projection.normal[i], normal[i], tolerance);
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(projection.turning[i][j], along * t[i] * t[j] + around * e[i] * e[j],
                  tolerance * (1 + std::abs(along)));
  }
}

TEST(RevolvedSurface, SphereIsExact) {
  const auto ball = surface(revolved(sphere(1.4)));  // its lowest point is the origin
  RandomPoints random({{-1, -1, -0.5}, {1, 1, 2}});
  for (int i = 0; i < 500; ++i) {
    const Point x = random.next(), d = x - Point{0, 0, 0.7};
    const double r = length(d);
    const SurfaceProjection projection = ball->closest(x);
    ASSERT_NEAR(projection.gap, r - 0.7, 1e-13);
    expect_turning(projection, 1 / r * d, 1 / r, 1 / r, 1e-11);
  }
}

TEST(RevolvedSurface, PointsOnAndNearTheAxisOfASphere) {
  const auto ball = surface(revolved(sphere(1.4)));
  for (const double off : {0.0, 1e-300, 1e-15, 1e-9, 1e-8, 1e-6})
    for (const double z : {-0.3, 0.0, 0.2, 1.1, 1.4, 1.9}) {
      const SurfaceProjection projection = ball->closest({0, off, z});
      const double r = std::hypot(off, z - 0.7);
      EXPECT_NEAR(projection.gap, r - 0.7, 1e-13);
      expect_turning(projection, {0, off / r, (z - 0.7) / r}, 1 / r, 1 / r, 1e-8);
    }
  const SurfaceProjection centre = ball->closest({0, 0, 0.7});  // all closest points are equally near
  EXPECT_NEAR(centre.gap, -0.7, 1e-13);
  for (const auto& row : centre.turning.at)
    for (const double value : row) EXPECT_TRUE(std::isfinite(value) && std::abs(value) < 10);
}

TEST(RevolvedSurface, ConeWithRoundedTipIsExact) {
  const double tip = 0.05, half = pi / 6;
  const auto cone = surface(revolved(rounded_cone(tip)));
  RandomPoints random({{-0.6, -0.6, -0.4}, {0.6, 0.6, 0.6}});
  int at_tip = 0, at_flank = 0;
  for (int i = 0; i < 2000; ++i) {
    const Point x = random.next();
    const double r = std::hypot(x[0], x[1]), z = x[2] - tip;  // from the centre of the tip
    const double along = r * std::sin(half) + z * std::cos(half), across = r * std::cos(half) - z * std::sin(half);
    if (across < 0.01) continue;  // near the axis inside or beyond the mirror line
    const SurfaceProjection projection = cone->closest(x);
    const double c = x[0] / r, s = x[1] / r;
    if (along < 0 && z < 0) {
      ++at_tip;
      const double rho = std::hypot(r, z);
      ASSERT_NEAR(projection.gap, rho - tip, 1e-12);
      expect_turning(projection, {x[0] / rho, x[1] / rho, z / rho}, 1 / rho, 1 / rho, 1e-9);
    } else if (along > 0 && along < 0.4 && r < 0.45) {
      ++at_flank;
      ASSERT_NEAR(projection.gap, across - tip, 1e-12);
      expect_turning(projection, {std::cos(half) * c, std::cos(half) * s, -std::sin(half)}, 0, std::cos(half) / r,
                     1e-9);
    }
  }
  EXPECT_GT(at_tip, 100);
  EXPECT_GT(at_flank, 100);
  for (const double z : {-0.3, -1e-3, 0.0, 0.02}) {  // below and within the tip, on the axis
    const SurfaceProjection projection = cone->closest({0, 0, z});
    EXPECT_NEAR(projection.gap, -z, 1e-13);
    expect_turning(projection, {0, 0, -1}, 1 / (tip - z), 1 / (tip - z), 1e-9);
  }
}

TEST(RevolvedSurface, CurvedTipNearTheAxis) {
  // a Bezier curve that leaves the axis at right angles, with the curvature 2/3 * 0.3 / 0.3^2 there
  const auto body =
      surface(revolved(text_parameter("type", "path") + array_parameter("start", "0, 0") +
                       section_xml("pieces", section_xml("tip", text_parameter("type", "bezier") +
                                                                    array_parameter("x", "0.3, 0.5, 0.5") +
                                                                    array_parameter("y", "0, 0.3, 1")))));
  const double curvature = 20.0 / 9;
  for (const double off : {0.0, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6})
    for (const double z : {-0.2, 0.0, 0.15}) {
      const SurfaceProjection projection = body->closest({-off, 0, z});
      const double turning = curvature / (1 - curvature * z);
      EXPECT_NEAR(projection.gap, -z, 1e-11);
      expect_turning(projection, {-turning * off, 0, -1}, turning, turning, 2e-5);
    }
}

TEST(RevolvedSurface, SharpTipFansOut) {
  const auto cone = surface(revolved(rounded_cone(0)));
  for (const double off : {0.0, 1e-12, 1e-7, 0.02}) {
    const SurfaceProjection projection = cone->closest({off, 0, -0.2});
    const double rho = std::hypot(off, 0.2);
    EXPECT_NEAR(projection.gap, rho, 1e-13);
    expect_turning(projection, {off / rho, 0, -0.2 / rho}, 1 / rho, 1 / rho, 1e-8);
  }
}

TEST(RevolvedSurface, CylinderIsExactAndGoesOn) {
  const auto pile = surface(revolved(text_parameter("type", "flat pile") + number_parameter("diameter", 1) +
                                     number_parameter("corner radius", 0.1)));
  for (const double r : {0.35, 0.5, 0.8})
    for (const double z : {1.0, 5.0, 70.0}) {
      const SurfaceProjection projection = pile->closest({0.6 * r, -0.8 * r, z});
      EXPECT_NEAR(projection.gap, r - 0.5, 1e-13);
      expect_turning(projection, {0.6, -0.8, 0}, 0, 1 / r, 1e-12);
      EXPECT_NEAR(projection.point[1], -0.4, 1e-13);
    }
  const SurfaceProjection base = pile->closest({0, 0, -0.3});
  EXPECT_NEAR(base.gap, 0.3, 1e-15);
  expect_turning(base, {0, 0, -1}, 0, 0, 1e-14);
  // on the axis inside the shaft all points around are equally near
  const SurfaceProjection axis = pile->closest({0, 0, 5});
  EXPECT_NEAR(axis.gap, -0.5, 1e-13);
  EXPECT_NEAR(axis.normal[0], 1, 1e-13);
  for (const auto& row : axis.turning.at)
    for (const double value : row) EXPECT_EQ(value, 0);
  EXPECT_TRUE(std::isinf(pile->bounds().high[2]));
  EXPECT_NEAR(pile->bounds().high[0], 0.5, 0.002);
  EXPECT_NEAR(pile->bounds().low[2], 0, 0.002);
  EXPECT_EQ(pile->moments().volume, 0);
  const SurfaceTriangles drawn = pile->triangles(0.01);
  EXPECT_GT(drawn.facets.size(), 20u);
  EXPECT_NO_THROW(closed_edges(drawn));  // with a lid where it is cut off
}

TEST(RevolvedSurface, DerivativesOfTheTorpedo) {
  const auto body = surface(revolved(torpedo()));
  const DerivativeErrors errors(*body, {{-1, -1, -0.8}, {1, 1, 13}}, 1e-6, 0.01, 2000);
  EXPECT_GT(errors.compared, 1800);
  EXPECT_LT(errors.normal, 1e-8);
  EXPECT_LT(errors.turning, 1e-4);  // inside near the axis the normals turn fast
  EXPECT_LT(errors.symmetry, 1e-12);
  EXPECT_LT(errors.along, 1e-12);
  EXPECT_LT(errors.projection, 1e-12);
  EXPECT_LT(errors.length, 1e-14);
}

TEST(RevolvedSurface, TheSameAllRound) {
  const auto body = surface(revolved(torpedo()));
  const RevolvedSurface& contour = dynamic_cast<const RevolvedSurface&>(*body);
  RandomPoints random({{-1, -1, -1}, {1, 1, 13}});
  for (int i = 0; i < 300; ++i) {
    const Point x = random.next();
    const ContourProjection plane = contour.contour().closest({std::hypot(x[0], x[1]), x[2]});
    const SurfaceProjection projection = body->closest(x);
    EXPECT_EQ(projection.gap, plane.gap);
    EXPECT_EQ(projection.normal[2], plane.normal[1]);
    EXPECT_EQ(projection.point[2], plane.point[1]);
  }
}

TEST(RevolvedSurface, MomentsOfTheSphereAndTheTorpedo) {
  const SolidMoments ball = surface(revolved(sphere(2)))->moments();
  EXPECT_NEAR(ball.volume, 4 * pi / 3, 1e-12);
  EXPECT_NEAR(ball.centroid()[2], 1, 1e-12);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(ball.inertia()[i][i], 8 * pi / 15, 1e-12);
  const auto body = surface(revolved(torpedo()));
  const SolidMoments exact = body->moments();
  const SurfaceTriangles drawn = body->triangles(1e-4);
  SolidMoments facets;
  for (std::size_t f = 0; f < drawn.facets.size(); ++f) {  // a flat facet's moments need the midpoints of its edges
    for (int k = 0; k < 3; ++k)
      facets.add_side(0.5 * (drawn.points[drawn.facets[f][k]] + drawn.points[drawn.facets[f][(k + 1) % 3]]),
                      1.0 / 6 * drawn.area_vector(f));
  }
  EXPECT_NEAR(facets.volume / exact.volume, 1, 1e-3);
  EXPECT_NEAR(facets.centroid()[2], exact.centroid()[2], 1e-3);
  EXPECT_NEAR(facets.inertia()[0][0] / exact.inertia()[0][0], 1, 1e-3);
  EXPECT_NEAR(facets.inertia()[2][2] / exact.inertia()[2][2], 1, 2e-3);
}

TEST(RevolvedSurface, TrianglesKeepTheChordErrorAndClose) {
  const auto body = surface(revolved(torpedo()));
  const SurfaceTriangles drawn = body->triangles(5e-3);
  EXPECT_NO_THROW(closed_edges(drawn));
  double worst = 0;
  for (const auto& facet : drawn.facets)
    for (int k = 0; k < 4; ++k) {
      const Point &a = drawn.points[facet[0]], &b = drawn.points[facet[1]], &c = drawn.points[facet[2]];
      const double u = k == 0 ? 1.0 / 3 : 0.5 * (k != 1), v = k == 0 ? 1.0 / 3 : 0.5 * (k != 2);
      const Point x = (1 - u - v) * a + u * b + v * c;
      worst = std::max(worst, std::abs(body->closest(x).gap));
      EXPECT_GE(x[2], body->bounds().low[2]);
      EXPECT_LE(x[0], body->bounds().high[0]);
    }
  EXPECT_LE(worst, 5e-3);
  EXPECT_GT(worst, 5e-4);
}

}  // namespace
}  // namespace mudline
