// Lode shapes and cones: constants of the literature, continuity, gradients against differences, the smooth maximum.
#include "materials/cone.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mudline {
namespace {

const double degree = std::acos(-1.0) / 180.0;

LodeShape shape(double friction, double transition) {
  return LodeShape::mohr_coulomb(std::sin(friction * degree), transition);
}
double at(const LodeShape& s, double theta) { return LodeAngle(-std::sin(3 * theta), s.edge)(s).k; }

// Checked independently for theta_T = 25 deg, phi = 30 deg.
TEST(LodeShape, ConstantsOfTheRounding) {
  const LodeShape s = shape(30, 25);
  EXPECT_NEAR(s.a[0], -4.89931, 1e-5);
  EXPECT_NEAR(s.b[0], 12.6495, 1e-4);
  EXPECT_NEAR(s.c[0], -7.00401, 1e-5);
  EXPECT_NEAR(s.a[1], -0.96184, 1e-5);
  EXPECT_NEAR(s.b[1], -4.32804, 1e-5);
  EXPECT_NEAR(s.c[1], -2.34769, 1e-5);
}

TEST(LodeShape, CornersAreOffByTheKnownAmount) {
  const auto excess = [](double transition, double theta) {
    const double exact = std::cos(theta * degree) - std::sin(theta * degree) * 0.5 / std::sqrt(3.0);
    return at(shape(30, transition), theta * degree) / exact - 1.0;
  };
  EXPECT_NEAR(excess(25, 30), 0.034, 5e-4);
  EXPECT_NEAR(excess(25, -30), 0.008, 5e-4);
  EXPECT_NEAR(excess(29, 30), 0.007, 2e-4);
  EXPECT_NEAR(excess(29, -30), 0.0016, 5e-5);
}

TEST(LodeShape, ValueSlopeAndCurvatureAreContinuousAtTheTransition) {
  for (const double friction : {0.0, 20.0, 30.0, 90.0})
    for (const double transition : {20.0, 25.0, 29.0})
      for (const double side : {-1.0, 1.0}) {
        SCOPED_TRACE(testing::Message() << friction << " " << transition << " " << side);
        const LodeShape s = shape(friction, transition);
        const LodeValue in = LodeAngle(side * s.edge * (1 - 1e-9), s.edge)(s),
                        out = LodeAngle(side * s.edge * (1 + 1e-9), s.edge)(s);
        EXPECT_NEAR(in.k, out.k, 1e-7);
        EXPECT_NEAR(in.slope, out.slope, 1e-6 * (1 + std::abs(in.slope)));
        EXPECT_NEAR(in.curvature, out.curvature, 1e-4 * (1 + std::abs(in.curvature)));
      }
}

TEST(LodeShape, DerivativesAgreeWithDifferences) {
  const LodeShape s = shape(25, 29);
  for (double lode = -1.0; lode <= 1.0; lode += 0.037) {
    const double h = 1e-6;
    const LodeValue v = LodeAngle(lode, s.edge)(s), low = LodeAngle(lode - h, s.edge)(s),
                    high = LodeAngle(lode + h, s.edge)(s);
    EXPECT_NEAR(v.slope, (high.k - low.k) / (2 * h), 1e-6 * (1 + std::abs(v.curvature)));
    EXPECT_NEAR(v.curvature, (high.slope - low.slope) / (2 * h), 1e-4 * (1 + std::abs(v.curvature)));
  }
}

TEST(LodeShape, RankineIsTheLargestPrincipalStress) {
  const LodeShape s = shape(90, 29);
  const double stress[6] = {-10, -35, -12, 4, 6, 9};
  double principal[3];
  sym6::principal_values(stress, principal);
  const ConeStress<double> c(stress, 1e-9);
  EXPECT_NEAR(c.yield(LodeAngle(c.lode, s.edge), s, 1.0, 0.0, 0.0), principal[0], 1e-12);
}

TEST(ConeStress, GradientAgreesWithDifferences) {
  for (const double transition : {29.0, 20.0}) {
    const LodeShape s = shape(30, transition);
    const double stress[6] = {-10, -35, -12, 4, 6, 9}, axis[6] = {-10, -35, -10.5, 0, 0, 1};
    for (const double* base : {stress, axis}) {
      const ConeStress<double> c(base, 1e-9);
      ConeGradient<double> g;
      double a[6];
      c.evaluate(LodeAngle(c.lode, s.edge), s, 0.5, 8.0, 0.4, g);
      c.expand(g, a);
      double squared = 0.0;
      for (int i = 0; i < 6; ++i) {
        double low[6], high[6];
        for (int j = 0; j < 6; ++j) low[j] = high[j] = base[j];
        low[i] -= 1e-5;
        high[i] += 1e-5;
        const ConeStress<double> l(low, 1e-9), h(high, 1e-9);
        const double slope = (h.yield(LodeAngle(h.lode, s.edge), s, 0.5, 8.0, 0.4) -
                              l.yield(LodeAngle(l.lode, s.edge), s, 0.5, 8.0, 0.4)) /
                             2e-5;
        EXPECT_NEAR(a[i], slope, 1e-7);
        const double e = i < 3 ? a[i] - 0.5 / 3 : a[i];
        squared += i < 3 ? e * e : 0.5 * e * e;
      }
      EXPECT_NEAR(c.shear_squared(g), squared, 1e-12);
    }
  }
}

TEST(SmoothExcess, IsExactBeyondItsWidthAndTwiceContinuouslyDifferentiable) {
  double weight;
  EXPECT_EQ(smooth_excess(2.0, 2.0, weight), 2.0);
  EXPECT_EQ(weight, 1.0);
  EXPECT_EQ(smooth_excess(-2.0, 2.0, weight), 0.0);
  EXPECT_EQ(weight, 0.0);
  EXPECT_NEAR(smooth_excess(0.0, 2.0, weight), 0.375, 1e-15);
  EXPECT_NEAR(smooth_excess(2.0 - 1e-9, 2.0, weight), 2.0, 1e-8);
  EXPECT_NEAR(weight, 1.0, 1e-15);
  for (double x = -1.9; x < 1.95; x += 0.1) {
    const double low = smooth_excess(x - 1e-5, 2.0, weight), high = smooth_excess(x + 1e-5, 2.0, weight);
    smooth_excess(x, 2.0, weight);
    EXPECT_NEAR(weight, (high - low) / 2e-5, 1e-9);
    EXPECT_GE(weight, 0.0);
  }
}

}  // namespace
}  // namespace mudline
