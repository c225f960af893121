#include "algebra/schur.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mudline {
namespace {

BlockData coefficients(double c, double s, double h, double g) {
  BlockData data;
  data.constrained_modulus = 1.3e7;
  data.inertia = c;
  data.storage = s;
  data.conduction = h;
  data.coupling_u = 2;
  data.coupling_p = g / 2;
  return data;
}

/// The symbol of the exact Schur complement and of the two terms, at the squared wave number x.
double exact_inverse(const BlockData& d, double x) {
  const double M = d.constrained_modulus, c = d.inertia, g = d.coupling_u * d.coupling_p;
  return 1 / (d.storage + d.conduction * x + g * x / (c + M * x));
}
double two_terms(const BlockData& d, double x) {
  const SchurCoefficients k = schur_coefficients(d, 1e-30);
  double sum = 0;
  if (k.wave) sum += 1 / (k.l1 * x + k.m1);
  if (k.consolidation) sum += 1 / (k.theta * (d.storage + d.conduction * x + k.sigma));
  return sum;
}

TEST(Schur, TwoTermsAreTheInverseSymbol) {
  for (const double dt : {1e-4, 1e-2, 1.0, 1e3})
    for (const double mobility : {1e-14, 1e-10, 1e-6, 1e-2})
      for (const double bulk : {1e5, 2.2e9}) {
        const BlockData d = coefficients(8000 / (dt * dt), 2 / dt * 0.4 / bulk, mobility, 2 / dt);
        for (const double x : {1e-2, 1.0, 1e4}) EXPECT_NEAR(two_terms(d, x) / exact_inverse(d, x), 1, 1e-6);
      }
}

TEST(Schur, LimitsStayFinite) {
  const BlockData impermeable = coefficients(8e5, 1e-9, 0, 20);
  const BlockData incompressible = coefficients(8e5, 0, 1e-8, 20);
  const BlockData uncoupled = coefficients(8e5, 1e-9, 1e-8, 0);
  for (const BlockData& d : {impermeable, incompressible, uncoupled})
    for (const double x : {1e-1, 1e1, 1e3}) EXPECT_NEAR(two_terms(d, x) / exact_inverse(d, x), 1, 1e-6);
}

TEST(Schur, QuasiStaticIsFixedStress) {
  BlockData d = coefficients(0, 1e-9, 1e-8, 20);
  const SchurCoefficients M_form = schur_coefficients(d, 1e-2);
  EXPECT_FALSE(M_form.wave);
  EXPECT_NEAR(M_form.theta, 1, 1e-12);
  EXPECT_NEAR(M_form.sigma, 20 / d.constrained_modulus, 1e-18);
  d.drained_modulus = 0.9e7;
  EXPECT_NEAR(schur_coefficients(d, 1e-2).sigma, 20 / 0.9e7, 1e-18);
}

}  // namespace
}  // namespace mudline
