// Increments of a law without a Lode angle in the space of two deviators against the same with six components: stress,
// hardening and tangent, for random states and strains and where a deviator is missing or both are parallel.
#include "materials/stress_space.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "materials/skeleton/modified_cam_clay.hpp"

namespace mudline {
namespace {

struct Answer {
  bool ok;
  double stress[6], h[2], tangent[36];
};

constexpr double volume = 2.1, pc = 120e3;

Answer six_components(const ModifiedCamClay& law, const double* stress, const double* strain) {
  Answer a;
  const ModifiedCamClayModel<SixComponents> model(law, {}, volume, pc);
  Dual<6> s[6], e[6], h[2] = {pc, 0.01};
  make_variable(strain, e);
  for (int i = 0; i < 6; ++i) s[i] = stress[i];
  a.ok = integrate_plasticity(model, law.integration, e, s, h);
  for (int i = 0; i < 6; ++i) a.stress[i] = value(s[i]);
  for (int i = 0; i < 2; ++i) a.h[i] = value(h[i]);
  write_tangent(s, a.tangent);
  return a;
}

Answer two_deviators(const ModifiedCamClay& law, const double* stress, const double* strain) {
  Answer a;
  using T = Dual<IncrementOfTwoDeviators<double>::directions>;
  const IncrementOfTwoDeviators<T> increment(stress, strain);
  const ModifiedCamClayModel<TwoDeviators<T>> model(law, increment.space, volume, pc);
  T s[3], h[2] = {pc, 0.01};
  increment.start(s);
  a.ok = integrate_plasticity(model, law.integration, increment.strain, s, h);
  increment.write(s, a.stress);
  for (int i = 0; i < 2; ++i) a.h[i] = value(h[i]);
  increment.write_tangent(s, a.tangent);
  return a;
}

void expect_equal(const ModifiedCamClay& law, const double* stress, const double* strain) {
  const Answer six = six_components(law, stress, strain), two = two_deviators(law, stress, strain);
  ASSERT_TRUE(six.ok && two.ok);
  double size = 0, largest = 0;
  for (double t : six.tangent) largest = std::max(largest, std::abs(t));
  for (double s : six.stress) size = std::max(size, std::abs(s));
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(two.stress[i], six.stress[i], 1e-11 * size) << i;
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(two.h[i], six.h[i], 1e-11 * std::abs(six.h[i])) << i;
  // the implicit return takes its derivatives before the last correction, which is below 1e-9
  for (int i = 0; i < 36; ++i) EXPECT_NEAR(two.tangent[i], six.tangent[i], 1e-8 * largest) << i;
}

class TwoDeviatorsTest : public ::testing::TestWithParam<IntegrationOptions::Method> {
 protected:
  TwoDeviatorsTest() {
    law.poisson = 0.3;
    law.integration.method = GetParam();
  }
  ModifiedCamClay law;
};

TEST_P(TwoDeviatorsTest, RandomIncrements) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    double stress[6], strain[6];
    const double p = pc * (0.45 + 0.25 * uniform(random)), steps[] = {1e-5, 1e-4, 1e-3, 1e-2};
    for (int c = 0; c < 6; ++c) stress[c] = 0.15 * p * uniform(random) - (c < 3 ? p : 0.0);
    for (double& e : strain) e = steps[i % 4] * uniform(random);
    expect_equal(law, stress, strain);
  }
}

TEST_P(TwoDeviatorsTest, DeviatorsThatAreMissingOrParallel) {
  const double round[6] = {-50e3, -50e3, -50e3, 0, 0, 0}, tall[6] = {-40e3, -80e3, -40e3, 0, 0, 0};
  const double squeezed[6] = {-1e-3, -1e-3, -1e-3, 0, 0, 0}, compressed[6] = {5e-3, -1e-2, 5e-3, 0, 0, 0},
               sheared[6] = {0, 0, 0, 0, 0, 4e-3}, back[6] = {-5e-3, 1e-2, -5e-3, 0, 0, 0};
  expect_equal(law, round, squeezed);
  expect_equal(law, round, sheared);
  expect_equal(law, tall, squeezed);
  expect_equal(law, tall, compressed);
  expect_equal(law, tall, sheared);
  expect_equal(law, tall, back);
}

TEST_P(TwoDeviatorsTest, NoStrainChangesNoBit) {
  const double none[6] = {};
  for (const double third : {-7e4 / 3, -5e4 / 7}) {
    const double stress[6] = {third, 1.1 * third, 0.9 * third, 0, 0, 0.1 * third};
    const Answer a = two_deviators(law, stress, none);
    ASSERT_TRUE(a.ok);
    for (int i = 0; i < 6; ++i) EXPECT_EQ(a.stress[i], stress[i]) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, TwoDeviatorsTest,
                         ::testing::Values(IntegrationOptions::Method::modified_euler,
                                           IntegrationOptions::Method::dormand_prince,
                                           IntegrationOptions::Method::implicit));

}  // namespace
}  // namespace mudline
