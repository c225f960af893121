// Observed orders of the integrators on Modified Cam Clay, implicit integration against the element tests, and the
// automatic tangent against an analytic one.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/skeleton/modified_cam_clay.hpp"
#include "point_driver.hpp"

namespace mudline {
namespace {

using Method = IntegrationOptions::Method;

ModifiedCamClay clay(Method method, double tolerance) {
  ModifiedCamClay law;
  law.ratio = 1.2;
  law.compression = 0.15;
  law.swelling = 0.03;
  law.poisson = 0.3;
  law.integration.method = method;
  law.integration.stress_tolerance = tolerance;
  law.integration.yield_tolerance = 1e-13;
  law.integration.maximum_substeps = 100000;
  return law;
}

/// Stress of a normally consolidated sample after shear in `steps` increments.
std::array<double, 6> shear(const ModifiedCamClay& parameters, int steps) {
  const PointwiseSkeleton<ModifiedCamClay> law(parameters);
  PointDriver point(law, {-90e3, -120e3, -100e3, 5e3, -8e3, 10e3}, 1.0);
  for (int i = 0; i < steps; ++i)
    point.step({2e-3 / steps, -1.2e-2 / steps, 1e-3 / steps, 2e-3 / steps, 0, 1e-2 / steps});
  return point.stress();
}

double distance(const std::array<double, 6>& a, const std::array<double, 6>& b) {
  double sum = 0.0;
  for (int i = 0; i < 6; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

TEST(Integration, ObservedOrders) {
  const auto exact = shear(clay(Method::dormand_prince, 1e-12), 8);
  const struct {
    Method method;
    double order;
    int coarse;
  } cases[] = {{Method::implicit, 2, 32}, {Method::modified_euler, 2, 32}, {Method::dormand_prince, 5, 4}};
  for (const auto& c : cases) {
    const ModifiedCamClay law = clay(c.method, 0.0999);  // so loose that each increment is one substep
    const double coarse = distance(shear(law, c.coarse), exact), fine = distance(shear(law, 2 * c.coarse), exact);
    EXPECT_NEAR(std::log2(coarse / fine), c.order, 0.15 * c.order) << coarse << " " << fine;
  }
}

TEST(Integration, ErrorFollowsTheTolerance) {
  const auto exact = shear(clay(Method::dormand_prince, 1e-12), 8);
  for (const Method method : {Method::modified_euler, Method::dormand_prince})
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6})
      EXPECT_LT(distance(shear(clay(method, tolerance), 1), exact), 20 * tolerance * 200e3);
}

// Element test of Modified Cam Clay, normally consolidated, axial strain 0.1: undrained p' 57.43695, q 68.92129 kPa.
TEST(Integration, ImplicitCamClayReachesTheElementTestsWithTwoHundredSteps) {
  const PointwiseSkeleton<ModifiedCamClay> law(clay(Method::implicit, 1e-4));
  PointDriver undrained(law, isotropic_stress(100e3), 1.0), drained(law, isotropic_stress(100e3), 1.0);
  compress(undrained, Path::undrained, 0.1, 200);
  EXPECT_NEAR(undrained.p(), 57.43695e3, 1e-4 * 57e3);
  EXPECT_NEAR(undrained.q(), 68.92129e3, 1e-4 * 69e3);
  compress(drained, Path::drained, 0.1, 200);
  EXPECT_NEAR(drained.p(), 145.9596e3, 1e-4 * 146e3);
  EXPECT_NEAR(drained.q(), 137.8789e3, 1e-4 * 138e3);
}

TEST(ModifiedCamClayStart, PreconsolidationFollowsFromTheNormalCompressionLine) {
  ModifiedCamClay law = clay(Method::modified_euler, 1e-4);
  law.normal_volume = 2.5;
  InitialPoint point{};
  point.stress = isotropic_stress(80e3);
  double state[ModifiedCamClay::state_size];
  const double pc = 240.0;  // [kPa]
  point.void_ratio =
      2.5 - 0.15 * std::log(pc) + 0.03 * std::log(pc / 80.0) - 1.0;  // down the line, back up by swelling
  ASSERT_EQ(law.initialise(point, state), "");
  EXPECT_NEAR(state[ModifiedCamClay::preconsolidation], pc * 1e3, 1e-6 * pc * 1e3);
  const double limit = 2.5 - 0.15 * std::log(80.0) - 1.0;  // normally consolidated
  point.void_ratio = limit + 0.01;
  const std::string reason = law.initialise(point, state);
  EXPECT_NE(reason.find("looser than the normal compression line"), std::string::npos);
  EXPECT_NE(reason.find(std::to_string(limit).substr(0, 5)), std::string::npos) << reason << limit;
  point.void_ratio = limit;
  EXPECT_EQ(law.initialise(point, state), "");
  point.overconsolidation_ratio = 2.0;
  EXPECT_NE(law.initialise(point, state), "");
}

/// The inverse: pc from the overconsolidation ratio, the void ratio from the line; a start with both agrees.
TEST(ModifiedCamClayStart, VoidRatioFollowsFromTheOverconsolidation) {
  ModifiedCamClay law = clay(Method::modified_euler, 1e-4);
  InitialPoint point{};
  point.stress = {-60e3, -120e3, -60e3, 0.0, 0.0, 0.0};
  point.overconsolidation_ratio = 2.0;
  EXPECT_EQ(law.void_ratio(point), Skeleton::no_void_ratio);
  const double p = 80.0, q = 60.0, pc = 2.0 * (p + q * q / (law.ratio * law.ratio * p));  // [kPa]
  const double e = 2.5 - 0.15 * std::log(pc) + 0.03 * std::log(pc / p) - 1.0;
  law.normal_volume = 2.5;
  EXPECT_NEAR(law.void_ratio(point), e, 1e-14);
  double state[ModifiedCamClay::state_size];
  point.void_ratio = law.void_ratio(point);
  ASSERT_EQ(law.initialise(point, state), "");
  EXPECT_NEAR(state[ModifiedCamClay::preconsolidation], pc * 1e3, 1e-9 * pc * 1e3);
  point.void_ratio += 1e-3;
  EXPECT_NE(law.initialise(point, state), "");
  law.normal_volume = 0.0;
  law.critical_volume = 2.5 - 0.12 * std::log(2.0) - 0.15 * std::log(50.0);  // the critical state at 50 kPa
  law.reference_pressure = 50e3;
  EXPECT_NEAR(law.void_ratio(point), e, 1e-13);
}

/// A law whose stiffness depends on the volume strain of the increment, so that the tangent is not the elastic matrix.
struct Stiffening {
  enum { state_size = 0 };
  static std::vector<StateVariable> state() { return {}; }
  std::string initialise(const InitialPoint&, double*) const { return ""; }
  ElasticModuli moduli(const double*, double, const double*) const { return {1e7, 5e6}; }
  void parameters(Parameters&) {}

  /// sigma = sigma_old + (1 - c tr eps) D eps
  template <class T>
  bool update(const SkeletonPoint& in, const T* strain, const double*, T* stress, double*) const {
    const T factor = 1.0 - 30.0 * sym6::trace(strain);
    sym6::isotropic(1e7, 5e6, strain, stress);
    for (int i = 0; i < 6; ++i) stress[i] = in.stress[i] + factor * stress[i];
    return value(factor) > 0.0;
  }
};

TEST(AutomaticTangent, IsTheAnalyticOneAndAFailedPointKeepsItsState) {
  const AutomaticTangent<Stiffening> law;
  SkeletonPoint in{{-1e4, -2e4, -1e4, 0, 0, 3e3}, {1e-3, -3e-3, 1e-3, 2e-3, 0, 1e-3}, 1.0, 0.0, 0.0, true};
  SkeletonResponse out;
  ASSERT_TRUE(law(in, nullptr, nullptr, out));
  double d[36], linear[6];
  sym6::isotropic_stiffness(1e7, 5e6, d);
  sym6::isotropic(1e7, 5e6, in.strain, linear);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double analytic = (1.0 - 30.0 * sym6::trace(in.strain)) * d[6 * i + j] - (j < 3 ? 30.0 * linear[i] : 0.0);
      EXPECT_NEAR(out.tangent[6 * i + j], analytic, 1e-8);
    }
  in.strain[0] = 1.0;
  EXPECT_FALSE(law(in, nullptr, nullptr, out));
  for (int i = 0; i < 6; ++i) EXPECT_EQ(out.stress[i], in.stress[i]);
}

}  // namespace
}  // namespace mudline
