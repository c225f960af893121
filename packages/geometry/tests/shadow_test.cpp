#include "geometry/shadow.hpp"

#include <gtest/gtest.h>

#include "core/pi.hpp"
#include "tensor/rotation.hpp"

namespace mudline {
namespace {

/// Corners of a box, turned.
std::vector<Point> box(const Point& lengths, const Rotation& turn) {
  std::vector<Point> corners;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5}) corners.push_back(turn({x * lengths[0], y * lengths[1], z * lengths[2]}));
  return corners;
}

TEST(Shadow, OfABoxAlongItsAxesIsAFace) {
  const Point lengths{4, 0.3, 0.2};
  for (const Rotation& turn : {Rotation{}, Rotation::by({0.3, -0.8, 1.1})}) {
    const std::vector<Point> corners = box(lengths, turn);
    const Shadow down = shadow_in_space(corners, turn({0, 0, -2})), along = shadow_in_space(corners, turn({1, 0, 0})),
                 across = shadow_in_space(corners, turn({0, 5, 0}));
    EXPECT_NEAR(down.width, 0.3, 1e-12);
    EXPECT_NEAR(down.length, 4, 1e-12);
    EXPECT_NEAR(along.width, 0.2, 1e-12);
    EXPECT_NEAR(along.length, 0.3, 1e-12);
    EXPECT_NEAR(across.width, 0.2, 1e-12);
    EXPECT_NEAR(across.length, 4, 1e-12);
  }
}

TEST(Shadow, OfALeaningBoxIsAsLongAsItLeans) {
  const double angle = 0.25 * pi;
  const std::vector<Point> corners = box({0.3, 0.3, 4}, Rotation::by({0, angle, 0}));
  const Shadow down = shadow_in_space(corners, {0, 0, 1});
  EXPECT_NEAR(down.width, 0.3, 1e-12);
  EXPECT_NEAR(down.length, (4 + 0.3) * std::sin(angle), 1e-12);
}

TEST(Shadow, OfABallIsItsDiameter) {
  std::vector<Point> points;
  const int n = 60;
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k < 2 * n; ++k) {
      const double polar = pi * i / n, around = pi * k / n;
      points.push_back({std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar)});
    }
  for (const Point& along : {Point{0, 0, 1}, Point{1, 0, 0}, Point{1, -2, 0.5}}) {
    const Shadow shadow = shadow_in_space(points, along);
    EXPECT_NEAR(shadow.width, 2, 0.01);
    EXPECT_NEAR(shadow.length, 2, 0.01);
  }
}

TEST(Shadow, OfALineOrAPointHasNoWidth) {
  EXPECT_NEAR(shadow_in_space({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {0, 0, 1}).width, 0, 1e-15);
  EXPECT_EQ(shadow_in_space({{1, 2, 3}}, {0, 0, 1}).length, 0);
  EXPECT_NEAR(extent_along({{0, 0, 0}, {3, 4, 0}}, {0.6, 0.8, 0}), 5, 1e-14);
}

}  // namespace
}  // namespace mudline
