// The driver of material points: mixed control, cuts, rotation, void ratio, and the documentation of its tests.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "materials/point/point_test.hpp"
#include "materials/pointwise.hpp"
#include "tensor/sym6.hpp"

namespace mudline {
namespace {

constexpr double bulk = 2e7, shear = 1e7;  // [Pa]

/// Linear elastic law that refuses increments above `longest` and counts the accepted ones in its state.
struct Careful {
  double longest = 1e300;
  void parameters(Parameters&) {}
  static std::vector<StateVariable> state() { return {{"count", 1, "-"}, {"direction", 6, "-"}}; }
  std::string initialise(const InitialPoint& point, double* state) const {
    for (int i = 0; i < 7; ++i) state[i] = i == 1 ? 1.0 : 0.0;  // the direction is x
    return point.void_ratio > 5.0 ? "too loose" : "";
  }
  ElasticModuli moduli(const double*, double, const double*) const { return {bulk, shear}; }
  KOKKOS_INLINE_FUNCTION bool operator()(const SkeletonPoint& in, const double* old, double* state,
                                         SkeletonResponse& out) const {
    for (int i = 0; i < 7; ++i) state[i] = old[i] + (i == 0 ? 1.0 : 0.0);
    for (const double e : in.strain)
      if (::fabs(e) > longest) return false;
    sym6::isotropic(bulk, shear, in.strain, out.stress);
    for (int i = 0; i < 6; ++i) out.stress[i] += in.stress[i];
    if (in.want_tangent) sym6::isotropic_stiffness(bulk, shear, out.tangent);
    return true;
  }
};

PointwiseSkeleton<Careful> careful(double longest = 1e300) {
  Careful law;
  law.longest = longest;
  return PointwiseSkeleton<Careful>(law);
}

InitialPoint start() { return {{}, {-1e5, -2e5, -1e5, 0, 0, 0}, 0.8, 1.0}; }

TEST(MaterialPoint, VoidRatioFollowsTheVolumeAsInAFullRun) {
  for (const double alpha : {1.0, 0.9}) {
    const auto law = careful();
    MaterialPoint point(law, start(), alpha);
    PointMotion motion;
    motion.strain = {-0.1, -0.05, 0.02, 0.3, 0, 0};
    point.commit(motion, 1.0, point.evaluate(motion, 1.0, false));
    const double n = alpha - (alpha - 0.8 / 1.8) * std::exp(0.13);
    EXPECT_NEAR(point.void_ratio(), n / (1 - n), 1e-14);
    EXPECT_EQ(point.time(), 1.0);
  }
}

TEST(MaterialPoint, SaysWhyALawCannotStart) {
  const auto law = careful();
  InitialPoint loose = start();
  loose.void_ratio = 6.0;
  EXPECT_EQ(MaterialPoint(law, loose).refusal(), "too loose");
  EXPECT_EQ(MaterialPoint(law, start()).refusal(), "");
}

TEST(PointControl, MixesStrainsAndStresses) {
  const auto law = careful();
  MaterialPoint point(law, start());
  PointControl control(point);
  PointIncrement increment;
  increment.stress_controlled = {true, false, true, false, true, false};
  increment.strain = {0, -0.01, 0, 0.002, 0, 0};
  increment.stress = {-1.5e5, 0, -1.2e5, 0, 3e4, 0};
  increment.dt = 2.0;
  ASSERT_TRUE(control.advance(increment));
  EXPECT_NEAR(point.stress()[0], -1.5e5, 1e-4);
  EXPECT_NEAR(point.stress()[2], -1.2e5, 1e-4);
  EXPECT_NEAR(point.stress()[3], shear * 0.002, 1e-6);
  EXPECT_NEAR(control.strain()[4], 3e4 / shear, 1e-12);
  EXPECT_NEAR(control.strain()[1], -0.01, 1e-15);
  EXPECT_EQ(control.cuts(), 0);
}

TEST(PointControl, HalvesWhatTheLawRefuses) {
  PointIncrement increment;
  increment.stress_controlled[0] = true;
  increment.strain[1] = -0.1;
  increment.stress[0] = -1e5;
  increment.dt = 8.0;
  const auto careless = careful(), law = careful(0.03);
  MaterialPoint whole(careless, start()), parts(law, start());
  PointControl one(whole), many(parts);
  ASSERT_TRUE(one.advance(increment) && many.advance(increment));
  EXPECT_EQ(many.cuts(), 3);  // 1 -> 2 -> 4 parts
  EXPECT_EQ(parts.state()[0], 4.0);
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(parts.stress()[c], whole.stress()[c], 1e-4);
  EXPECT_EQ(parts.time(), 8.0);
}

TEST(PointControl, GivesUpWhereNoPartIsSmallEnough) {
  const auto law = careful(1e-9);
  MaterialPoint point(law, start());
  PointControl control(point);
  PointIncrement increment;
  increment.strain[1] = -0.1;
  increment.dt = 1.0;
  EXPECT_FALSE(control.advance(increment));
  EXPECT_EQ(point.stress(), start().stress);
}

// Simple shear by sliding planes: the planes stay parallel, the material rotates by half the shear (Jaumann).
TEST(PointControl, SlidingTurnsStressAndTensorsOfTheState) {
  const auto law = careful();
  MaterialPoint point(law, start());
  PointControl control(point);
  PointIncrement increment;
  increment.sliding = true;
  increment.strain[5] = 0.001;
  increment.dt = 1.0;
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(control.advance(increment));
  const double gamma = 1.0, c = std::cos(gamma / 2), s = -std::sin(gamma / 2);
  EXPECT_NEAR(point.state()[1], c * c, 1e-7);
  EXPECT_NEAR(point.state()[2], s * s, 1e-7);
  EXPECT_NEAR(point.state()[6], c * s, 1e-7);
  // stress: the rotated initial stress plus Jaumann's G (sin, 1 - cos)
  EXPECT_NEAR(point.stress()[5], c * s * 1e5 + shear * std::sin(gamma), 2.0);
  EXPECT_NEAR(point.stress()[0], -1e5 * c * c - 2e5 * s * s + shear * (1 - std::cos(gamma)), 2.0);
  EXPECT_NEAR(point.void_ratio(), 0.8, 1e-14);
  EXPECT_EQ(control.strain()[1], 0.0);
}

TEST(PointControl, SlidingUnderVerticalStress) {
  const auto law = careful();
  MaterialPoint point(law, start());
  PointControl control(point);
  PointIncrement increment;
  increment.sliding = increment.stress_controlled[1] = true;
  increment.strain[5] = 0.01;
  increment.stress[1] = -2e5;
  increment.dt = 1.0;
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(control.advance(increment));
  EXPECT_NEAR(point.stress()[1], -2e5, 1e-3);
  EXPECT_NEAR(1.0 + point.void_ratio(), 1.8 * std::exp(control.strain()[1]), 1e-12);
  EXPECT_GT(control.strain()[1], 1e-4);  // Jaumann's elasticity dilates
}

TEST(PointTests, AreDocumented) {
  Registry<PointTest> tests("test");
  register_point_tests(tests);
  EXPECT_EQ(tests.names().size(), 7u);
  for (const EntryDoc& entry : tests.document()) {
    EXPECT_FALSE(entry.summary.empty());
    for (const ParameterDoc& p : entry.parameters)
      EXPECT_GT(std::count(p.doc.begin(), p.doc.end(), ' '), 2) << entry.name << ": " << p.name;
  }
}

}  // namespace
}  // namespace mudline
