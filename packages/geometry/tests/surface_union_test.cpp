#include "geometry/surface_union.hpp"

#include <cmath>

#include "core/pi.hpp"
#include "geometry/rounded_box.hpp"
#include "geometry/tests/surface_fixture.hpp"

namespace mudline {
namespace {

std::shared_ptr<const Surface> box(double x, double y, double z, double fillet) {
  return std::make_shared<RoundedBox>(Point{x, y, z}, fillet);
}

std::shared_ptr<const Surface> ball(double radius) { return box(2 * radius, 2 * radius, 2 * radius, radius); }

TEST(PlacedSurface, TurnsAboutItsOrigin) {
  PlacedSurface plate{box(2, 1, 0.2, 0.05), {3, 0, 1}};
  plate.rotation = Rotation::by({0, 0, pi / 2});
  const SurfaceProjection projection = plate.closest({3, 1.5, 1});  // beyond its end in x, which is now in y
  EXPECT_NEAR(projection.gap, 0.5, 1e-14);
  EXPECT_NEAR(projection.normal[1], 1, 1e-14);
  EXPECT_NEAR(projection.point[1], 1, 1e-14);
  EXPECT_NEAR(plate.bounds().high[1], 1, 1e-12);
  EXPECT_NEAR(plate.bounds().low[0], 2.5, 1e-12);
  plate.rotation = Rotation::by({pi / 6, 0, 0});
  EXPECT_NEAR(plate.rotation.matrix[2][1], 0.5, 1e-15);  // right-handed about x: y goes towards z
}

TEST(SurfaceUnion, DerivativesOfATurnedPart) {
  PlacedSurface plate{box(2, 1, 0.4, 0.1), {0.3, -0.2, 0.1}};
  plate.rotation = Rotation::by({0.4, -0.7, 0.9});
  const SurfaceUnion body({plate});
  const DerivativeErrors errors(body, {{-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}}, 1e-6, 0.01);
  EXPECT_GT(errors.compared, 450);
  EXPECT_LT(errors.normal, 1e-6);
  EXPECT_LT(errors.turning, 1e-4);
  EXPECT_LT(errors.symmetry, 1e-13);
  EXPECT_LT(errors.along, 1e-12);
  EXPECT_LT(errors.projection, 1e-14);
}

TEST(SurfaceUnion, TheSmallestGapCounts) {
  const SurfaceUnion two({{ball(1), {-0.8, 0, 0}}, {ball(0.7), {0.8, 0, 0}}});
  RandomPoints random({{-2.5, -1.5, -1.5}, {2.5, 1.5, 1.5}});
  for (int i = 0; i < 500; ++i) {
    const Point x = random.next();
    const double a = std::hypot(x[0] + 0.8, x[1], x[2]) - 1, b = std::hypot(x[0] - 0.8, x[1], x[2]) - 0.7;
    const SurfaceProjection projection = two.closest(x);
    EXPECT_NEAR(projection.gap, std::min(a, b), 1e-13);
    EXPECT_EQ(projection.part, a <= b ? 0 : 1);
  }
  EXPECT_NEAR(two.bounds().low[0], -1.8, 1e-12);
  EXPECT_NEAR(two.bounds().high[0], 1.5, 1e-12);
  EXPECT_EQ(two.triangles(0.1).facets.size(),
            ball(1)->triangles(0.1).facets.size() + ball(0.7)->triangles(0.1).facets.size());
}

TEST(SurfaceUnion, FinsOnAShaftThatGoesOn) {
  const auto shaft = surface(revolved(text_parameter("type", "flat pile") + number_parameter("diameter", 1)));
  std::vector<PlacedSurface> parts{{shaft}};
  for (int i = 0; i < 4; ++i) {
    const double angle = pi / 2 * i;
    PlacedSurface fin{box(1, 0.05, 2, 0.02), {0.8 * std::cos(angle), 0.8 * std::sin(angle), 3}};
    fin.rotation = Rotation::by({0, 0, angle});
    parts.push_back(fin);
  }
  const SurfaceUnion body(parts);
  EXPECT_EQ(body.closest({0.6, 0.6, 3}).part, 0);
  EXPECT_EQ(body.closest({0.1, 1.2, 3}).part, 2);
  EXPECT_NEAR(body.closest({0.1, 1.2, 3}).gap, 0.075, 1e-14);
  EXPECT_EQ(body.closest({0.1, 1.2, 30}).part, 0);
  EXPECT_NEAR(body.closest({-0.4, 0, 3}).gap, -0.1, 1e-14);  // the root of a fin is inside the hull
  EXPECT_TRUE(std::isinf(body.bounds().high[2]));
  EXPECT_NEAR(body.bounds().high[0], 1.3, 1e-12);
  EXPECT_EQ(body.moments().volume, 0);
}

TEST(SurfaceUnion, MomentsWithoutWhatPartsShare) {
  // half of the second box is within the first one
  PlacedSurface small{box(1, 0.5, 0.5, 0), {1, 0, 0}};
  const SolidMoments aligned = SurfaceUnion({{box(2, 2, 2, 0)}, small}).moments();
  EXPECT_NEAR(aligned.volume, 8.125, 1e-12);
  EXPECT_NEAR(aligned.centroid()[0], 0.125 * 1.25 / 8.125, 1e-12);
  small.rotation = Rotation::by({0.5, 0, 0});  // about the axis along which it sticks out
  EXPECT_NEAR(SurfaceUnion({{box(2, 2, 2, 0)}, small}).moments().volume, 8.125, 1e-12);
  // two balls, their centres 1 m apart: a lens of two caps of the height 0.5 m
  const SurfaceUnion balls({{ball(1)}, {ball(1), {0.6, 0, 0.8}}});
  const SolidMoments lens = balls.moments();
  const double cap = pi * 0.25 * (1 - 0.5 / 3);
  EXPECT_NEAR(lens.volume, 8 * pi / 3 - 2 * cap, 3e-3);
  EXPECT_NEAR(lens.centroid()[0], 0.3, 1e-4);
  EXPECT_NEAR(lens.centroid()[2], 0.4, 1e-4);
  // three parts at one place are one
  EXPECT_NEAR(SurfaceUnion({{ball(1)}, {ball(1)}, {ball(0.5)}}).moments().volume, 4 * pi / 3, 4e-3);
}

}  // namespace
}  // namespace mudline
