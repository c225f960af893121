#include "tensor/sym6.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mudline {
namespace {

const double stress[6] = {-120.0, -75.0, -60.0, 12.0, -8.0, 21.0};

TEST(Sym6, InvariantsOfTriaxialStates) {
  const double compression[6] = {-1.0, -3.0, -1.0, 0, 0, 0};
  const double extension[6] = {-3.0, -1.0, -3.0, 0, 0, 0};
  const sym6::Invariants c = sym6::invariants(compression), e = sym6::invariants(extension);
  EXPECT_NEAR(c.p, 5.0 / 3.0, 1e-15);
  EXPECT_NEAR(c.q, 2.0, 1e-15);
  EXPECT_NEAR(c.lode, -1.0, 1e-14);
  EXPECT_NEAR(e.lode, 1.0, 1e-14);
  const double none[6] = {-5, -5, -5, 0, 0, 0};
  EXPECT_EQ(sym6::invariants(none).lode, 0.0);
}

TEST(Sym6, PrincipalValuesOfKnownTensors) {
  const double diagonal[6] = {2.0, -7.0, 4.0, 0, 0, 0};
  double p[3];
  sym6::principal_values(diagonal, p);
  EXPECT_NEAR(p[0], 4.0, 1e-13);
  EXPECT_NEAR(p[1], 2.0, 1e-13);
  EXPECT_NEAR(p[2], -7.0, 1e-13);
  sym6::principal_values(stress, p);
  EXPECT_NEAR(p[0] + p[1] + p[2], sym6::trace(stress), 1e-11);
  EXPECT_NEAR(p[0] * p[1] * p[2], sym6::determinant(stress), 1e-7);
  EXPECT_NEAR(p[0] * p[0] + p[1] * p[1] + p[2] * p[2], sym6::norm_squared(stress), 1e-9);
  EXPECT_GE(p[0], p[1]);
  EXPECT_GE(p[1], p[2]);
}

TEST(Sym6, RotationKeepsInvariantsAndTurnsComponents) {
  const double c = std::cos(0.6), s = std::sin(0.6);
  const double about_z[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
  const double x_only[6] = {10.0, 0, 0, 0, 0, 0};
  double out[6];
  sym6::rotate(about_z, x_only, out);
  EXPECT_NEAR(out[0], 10 * c * c, 1e-14);
  EXPECT_NEAR(out[1], 10 * s * s, 1e-14);
  EXPECT_NEAR(out[5], 10 * c * s, 1e-14);
  const double tilted[9] = {c, 0, s, s * s, c, -s * c, -s * c, s, c * c};
  sym6::rotate(tilted, stress, out);
  const sym6::Invariants a = sym6::invariants(stress), b = sym6::invariants(out);
  EXPECT_NEAR(a.p, b.p, 1e-12);
  EXPECT_NEAR(a.q, b.q, 1e-12);
  EXPECT_NEAR(a.lode, b.lode, 1e-12);
}

TEST(Sym6, DeterminantGradientAgreesWithDuals) {
  Dual<6> sigma[6], s[6];
  for (int i = 0; i < 6; ++i) sigma[i] = Dual<6>(stress[i], i);
  sym6::deviator(sigma, s);
  const Dual<6> j3 = sym6::determinant(s);
  double plain[6], gradient[6];
  sym6::deviator(stress, plain);
  sym6::determinant_gradient(plain, 1.5 * sym6::norm_squared(plain), gradient);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(gradient[i], j3.d[i], 1e-11);
}

TEST(Sym6, IsotropicElasticityDoesTheRightWork) {
  const double strain[6] = {1e-3, -2e-3, 5e-4, 3e-3, 1e-3, -4e-3};
  double out[6];
  sym6::isotropic(3e6, 1e6, strain, out);
  EXPECT_NEAR(sym6::mean_pressure(out), 3e6 * 5e-4, 1e-9);
  EXPECT_NEAR(out[3], 3e3, 1e-9);
  EXPECT_NEAR(out[0] - out[1], 2e6 * 3e-3, 1e-9);
  EXPECT_GT(sym6::work(out, strain), 0.0);
}

}  // namespace
}  // namespace mudline
