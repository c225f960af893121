// Neo-Hookean elasticity against closed forms: sigma = (G/J)(b - 1) + (Lambda ln J/J) 1.
#include "materials/skeleton/neo_hookean.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "point_driver.hpp"

namespace mudline {
namespace {

constexpr double shear = 1e7 / 2.6, lambda = 1e7 * 0.3 / (1.3 * 0.4);
using Law = PointwiseSkeleton<AutomaticTangent<NeoHookean>>;

Law law() {
  NeoHookean r;
  r.young = 1e7;
  r.poisson = 0.3;
  return Law(r);
}

TEST(NeoHookean, LargeStretchInOneStepOrMany) {
  const double x = std::log(1.8), y = std::log(0.7), z = std::log(1.2), j = 1.8 * 0.7 * 1.2;
  for (const int steps : {1, 10}) {
    const Law soil = law();
    PointDriver point(soil, {}, 0.8);
    for (int i = 0; i < steps; ++i) point.step({x / steps, y / steps, z / steps, 0, 0, 0});
    const double stretch[3] = {1.8, 0.7, 1.2};
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(point.stress()[i], shear / j * (stretch[i] * stretch[i] - 1) + lambda * std::log(j) / j, 1e-6);
  }
}

// A closed path of stretches along rotated axes returns to its start: deps and -deps are exact inverses.
TEST(NeoHookean, ReversedStrainReturnsTheStress) {
  const Law soil = law();
  PointDriver point(soil, {-2e4, -5e4, -3e4, 0, 1e3, 8e3}, 0.8);
  const auto start = point.stress();
  point.step({0.1, -0.2, 0.05, 0.1, -0.3, 0.4});
  point.step({-0.1, 0.2, -0.05, -0.1, 0.3, -0.4});
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(point.stress()[i], start[i], 1e-6);
}

TEST(NeoHookean, CarriesTheInitialStress) {
  const Law soil = law();
  for (const double p : {-1e5, 0.0, 1e4, 3e6}) {
    const std::array<double, 6> start = {-p, -1.5 * p, -0.8 * p, 0.1 * p, 0, 0.2 * p};
    const PointDriver point(soil, start, 0.8);
    std::array<double, 6> stress;
    std::vector<double> state;
    ASSERT_TRUE(point.evaluate({}, stress, state));
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(stress[i], start[i], 1e-6 + 1e-9 * std::abs(p));
  }
}

}  // namespace
}  // namespace mudline
