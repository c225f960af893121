#include <gtest/gtest.h>

#include <cmath>

#include "discretisation/piecewise_polynomial.hpp"

namespace mudline {
namespace {

TEST(PiecewisePolynomial, SmoothCurveWithItsDerivatives) {
  const auto f = [](double t) { return PlanePoint{std::cos(3 * t), std::exp(t)}; };
  const auto runs = polynomial_runs(f, 0, 1, 1e-11);
  ASSERT_LE(runs.size(), 2u);
  ASSERT_FALSE(runs.empty());
  EXPECT_NEAR(runs.front().at(0).x[1], 1, 1e-14);
  EXPECT_NEAR(runs.back().at(1).x[0], std::cos(3.0), 1e-14);
  const double share = 1.0 / runs.size();
  const auto mid = runs[0].at(0.5);
  EXPECT_NEAR(mid.d[0], -3 * share * std::sin(1.5 * share), 1e-8);
  EXPECT_NEAR(mid.dd[0], -9 * share * share * std::cos(1.5 * share), 1e-6);
  const auto back = runs[0].reversed().at(0.3), forth = runs[0].at(0.7);
  EXPECT_NEAR(back.x[0], forth.x[0], 1e-15);
  EXPECT_NEAR(back.d[1], -forth.d[1], 1e-13);
}

TEST(PiecewisePolynomial, CutsAtACornerAndAtAJumpOfCurvature) {
  const double corner = 0.3137, jump = 0.711;
  const auto f = [&](double t) {
    return PlanePoint{t, std::abs(t - corner) + (t > jump ? (t - jump) * (t - jump) : 0.0)};
  };
  const auto runs = polynomial_runs(f, 0, 1, 1e-11);
  ASSERT_GE(runs.size(), 3u);
  EXPECT_LE(runs.size(), 7u);
  double nearest[2] = {1, 1};
  for (const PolynomialRun& run : runs)
    for (double t : {0.0, 1.0}) {
      nearest[0] = std::min(nearest[0], std::abs(run.at(t).x[0] - corner));
      nearest[1] = std::min(nearest[1], std::abs(run.at(t).x[0] - jump));
    }
  EXPECT_LT(nearest[0], 1e-9);
  EXPECT_LT(nearest[1], 1e-4);
}

TEST(PiecewisePolynomial, CubicKeepsItsDegree) {
  const auto f = [](double t) { return PlanePoint{t * t * t - t, 2 * t * t}; };
  const auto runs = polynomial_runs(f, -1, 2, 1e-11);
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].coefficients.size(), 4u);
}

TEST(PiecewisePolynomial, GapCannotBeFollowed) {
  EXPECT_TRUE(polynomial_runs([](double t) { return PlanePoint{t, t < 0.4 ? 0.0 : 1.0}; }, 0, 1, 1e-11).empty());
}

}  // namespace
}  // namespace mudline
