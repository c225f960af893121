#include "ale/side_locator.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mudline {

namespace {

/// Curved triangles of six nodes at random places in a cube.
class SideLocatorTest : public ::testing::Test {
 protected:
  SideLocatorTest() {
    for (int f = 0; f < 60; ++f) {
      const int n = static_cast<int>(x.size());
      faces.push_back({CellShape::tri6, {n, n + 1, n + 2, n + 3, n + 4, n + 5}});
      const Point around = somewhere(4.0);
      for (int a = 0; a < 3; ++a) x.push_back(around + somewhere(1.0));
      for (int a = 0; a < 3; ++a) x.push_back(0.5 * (x[n + a] + x[n + (a + 1) % 3]) + somewhere(0.05));
    }
  }
  Point somewhere(double size) {
    std::uniform_real_distribution<double> any(0, size);
    return {any(random), any(random), any(random)};
  }

  std::mt19937 random{7};
  Positions x;
  std::vector<CurvedSide> faces;
};

}  // namespace

TEST_F(SideLocatorTest, FindsWhatALookAtEverySideFinds) {
  const SideLocator locator(faces, x);
  for (int k = 0; k < 300; ++k) {
    const Point point = somewhere(5.0);
    int nearest = -1;
    double least = 1e300;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const ClosestOnSide there = closest_on_side(faces[f], x, point);
      if (there.distance >= least) continue;
      least = there.distance;
      nearest = static_cast<int>(f);
    }
    SideLocator::Place found;
    locator.approach(point, found);
    EXPECT_EQ(found.side, nearest);
    EXPECT_EQ(found.distance, least);
  }
}

TEST_F(SideLocatorTest, ACloserPlaceStays) {
  const SideLocator locator(faces, x);
  SideLocator::Place found{17, {0.25, 0.25}, 1e-6};
  locator.approach({-3, -3, -3}, found);
  EXPECT_EQ(found.side, 17);
  EXPECT_EQ(found.distance, 1e-6);
}

TEST(SideLocator, OfEquallyCloseSidesItIsTheFirst) {
  const Positions x = {{-1, 1, 0}, {1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {5, 0, 0}, {6, 0, 0}};
  const CurvedSide up{CellShape::line2, {0, 1}}, down{CellShape::line2, {2, 3}}, far{CellShape::line2, {4, 5}};
  for (const auto& sides : {std::vector{far, up, down}, std::vector{far, down, up}}) {
    SideLocator::Place found;
    SideLocator(sides, x).approach({0.5, 0, 0}, found);
    EXPECT_EQ(found.side, 1);
    EXPECT_NEAR(found.xi[0], 0.5, 1e-14);
    EXPECT_EQ(found.distance, 1);
  }
}

}  // namespace mudline
