// Tresca and von Mises against closed forms: strength, strain rate, softening, hardening.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/skeleton/tresca.hpp"
#include "materials/skeleton/von_mises.hpp"
#include "point_driver.hpp"

namespace mudline {
namespace {

using Method = IntegrationOptions::Method;

Tresca clay() {
  Tresca law;
  law.strength.value = 20e3;
  law.rigidity = 100.0;
  law.poisson = 0.45;
  return law;
}

/// Simple shear of one point with time, without a driver: stress and state after `steps` increments.
struct Shear {
  double stress[6] = {-50e3, -50e3, -50e3, 0, 0, 0}, state[2] = {20e3, 0.0};
  void run(const Tresca& parameters, double increment, double dt, int steps) {
    AutomaticTangent<Tresca> law(parameters);
    law.prepare();
    for (int n = 0; n < steps; ++n) {
      SkeletonPoint in{{}, {0, 0, 0, 0, 0, increment}, 1.0, 0.0, dt, true};
      SkeletonResponse out;
      double old[2] = {state[0], state[1]};
      for (int i = 0; i < 6; ++i) in.stress[i] = stress[i];
      ASSERT_TRUE(law(in, old, state, out));
      for (int i = 0; i < 6; ++i) stress[i] = out.stress[i];
    }
  }
};

TEST(Tresca, SimpleShearToFiveKeepsTheStrength) {
  for (const Method method : {Method::implicit, Method::modified_euler, Method::dormand_prince}) {
    Tresca law = clay();
    law.integration.method = method;
    Shear shear;
    shear.run(law, 0.05, 0.0, 100);
    EXPECT_NEAR(shear.stress[5], 20e3, 1e-9 * 20e3);
    EXPECT_NEAR(shear.state[1], 5.0 - 20e3 / 2e6, 1e-8);
  }
}

TEST(Tresca, TriaxialStrengthIsThatOfTheRoundedCorner) {
  Tresca parameters = clay();
  const LodeShape shape = LodeShape::mohr_coulomb(0.0, 29.0);
  const double expected = std::sqrt(3.0) * 20e3 / LodeAngle(-1.0, shape.edge)(shape).k;
  EXPECT_NEAR(expected, 40e3, 0.004 * 40e3);
  const PointwiseSkeleton<AutomaticTangent<Tresca>> law(parameters);
  PointDriver point(law, isotropic_stress(100e3), 1.0);
  compress(point, Path::undrained, 0.05, 20);
  EXPECT_NEAR(point.q(), expected, 1e-6 * expected);
  EXPECT_NEAR(point.p(), 100e3, 1e-3);
}

TEST(Tresca, StrengthFollowsTheRate) {
  for (const double rate : {1e-7, 1e-5, 1e-3, 1.0}) {
    Tresca law = clay();
    law.rate = Tresca::Rate::logarithmic;
    law.rate_coefficient = 0.12;
    Shear logarithmic, power, still;
    logarithmic.run(law, 0.01, 0.01 / rate, 10);
    const double ratio = std::max(rate, 1e-5) / 1e-5;
    EXPECT_NEAR(logarithmic.stress[5], 20e3 * (1 + 0.12 * std::log10(ratio)), 1e-8 * 20e3);
    law.rate = Tresca::Rate::power;
    law.rate_exponent = 0.07;
    power.run(law, 0.01, 0.01 / rate, 10);
    EXPECT_NEAR(power.stress[5], 20e3 * std::pow(ratio, 0.07), 1e-8 * 20e3);
    still.run(law, 0.01, 0.0, 10);
    EXPECT_NEAR(still.stress[5], 20e3, 1e-8 * 20e3);
    power.run(law, 0.0, 1.0, 1);  // at rest the rate-dependent strength vanishes
    EXPECT_NEAR(power.stress[5], 20e3, 1e-8 * 20e3);
  }
}

TEST(Tresca, SoftensAsInClosedForm) {
  for (const Method method : {Method::implicit, Method::modified_euler}) {
    Tresca law = clay();
    law.sensitivity = 4.0;
    law.ductility = 2.0;
    law.integration.method = method;
    law.integration.maximum_substeps = 100000;
    Shear shear;
    shear.run(law, 0.02, 0.0, 100);
    const double xi = shear.state[1];
    EXPECT_NEAR(xi, 2.0 - shear.stress[5] / 2e6, 1e-8);
    EXPECT_NEAR(shear.stress[5], 20e3 * (0.25 + 0.75 * std::exp(-3 * xi / 2.0)), 1e-8 * 20e3);
    EXPECT_NEAR(*law.soil_state(shear.stress, 1.0, shear.state).undrained_strength, shear.stress[5], 1e-8 * 20e3);
    shear.run(law, 0.05, 0.0, 200);
    EXPECT_NEAR(shear.stress[5], 5e3, 1e-3);
  }
}

TEST(Tresca, TangentIncludesTheRate) {
  Tresca parameters = clay();
  parameters.rate = Tresca::Rate::logarithmic;
  parameters.sensitivity = 3.0;
  AutomaticTangent<Tresca> law(parameters);
  law.prepare();
  for (const Method method : {Method::implicit, Method::modified_euler}) {
    law.integration.method = method;
    SkeletonPoint in{
        {-50e3, -60e3, -55e3, 1e3, 2e3, 15e3}, {1e-3, -4e-3, 2e-3, 1e-3, -2e-3, 9e-3}, 1.0, 0.0, 0.5, true};
    const double old[2] = {20e3, 0.1};
    double state[2];
    SkeletonResponse out, low, high;
    ASSERT_TRUE(law(in, old, state, out));
    for (int j = 0; j < 6; ++j) {
      SkeletonPoint moved = in;
      moved.strain[j] += 1e-7;
      ASSERT_TRUE(law(moved, old, state, high));
      moved.strain[j] -= 2e-7;
      ASSERT_TRUE(law(moved, old, state, low));
      for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(out.tangent[6 * i + j], (high.stress[i] - low.stress[i]) / 2e-7, 1e-6 * 2e7) << i << j;
    }
  }
}

VonMises metal() {
  VonMises law;
  law.elasticity = {200e6, 0.3};
  law.yield_stress = 100e3;
  return law;
}

TEST(VonMises, SimpleShearWithLinearHardeningInClosedForm) {
  for (const Method method : {Method::implicit, Method::modified_euler, Method::dormand_prince}) {
    VonMises parameters = metal();
    parameters.hardening = 5e6;
    parameters.integration.method = method;
    const PointwiseSkeleton<AutomaticTangent<VonMises>> law(parameters);
    PointDriver point(law, {}, 1.0);
    for (int i = 0; i < 10; ++i) point.step({0, 0, 0, 0, 0, 1e-3});
    const double shear = 200e6 / 2.6, strain = 1e-2 / std::sqrt(3.0);  // q = 3 G (strain - k) = sigma_0 + H k
    const double k = (3 * shear * strain - 100e3) / (3 * shear + 5e6);
    EXPECT_NEAR(point.state()[0], k, 1e-8);
    EXPECT_NEAR(point.q(), 100e3 + 5e6 * k, 1e-6 * 100e3);
  }
}

TEST(VonMises, UniaxialTensionWithVoceSaturation) {
  VonMises parameters = metal();
  parameters.saturation = 50e3;
  parameters.saturation_rate = 30.0;
  const PointwiseSkeleton<AutomaticTangent<VonMises>> law(parameters);
  PointDriver point(law, isotropic_stress(1.0), 1.0);
  for (int i = 0; i < 50; ++i) point.step({0, 2e-3, 0, 0, 0, 0}, {true, false, true, false, false, false});
  const double k = point.state()[0], yield = 100e3 + 50e3 * (1 - std::exp(-30 * k));
  EXPECT_NEAR(point.q(), yield, 1e-8 * yield);
  EXPECT_NEAR(point.strain()[1], k + point.q() / 200e6, 1e-8);
}

}  // namespace
}  // namespace mudline
