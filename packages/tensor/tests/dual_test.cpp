#include "tensor/dual.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mudline {
namespace {

// Uses every operator and function once so that no derivative vanishes.
template <class T>
T everything(const T& x, const T& y) {
  T a = x * y + 2.0 * x - y / 3.0 + (1.0 - x) * (-y);
  a += x / y + 1.0 / y;
  a -= exponential(x * y) - 0.5;
  a *= square_root(x + 2.0);
  a /= 1.0 + y * y;
  a *= 3.0;
  a += logarithm(x * x + y);
  return a * exponential_quotient(x - y);
}

TEST(Dual, DerivativesAgreeWithCentralDifferences) {
  const double x = 0.7, y = 1.3, h = 1e-5;
  const Dual<2> r = everything(Dual<2>(x, 0), Dual<2>(y, 1));
  EXPECT_DOUBLE_EQ(r.v, everything(x, y));
  EXPECT_NEAR(r.d[0], (everything(x + h, y) - everything(x - h, y)) / (2 * h), 1e-8);
  EXPECT_NEAR(r.d[1], (everything(x, y + h) - everything(x, y - h)) / (2 * h), 1e-8);
}

TEST(Dual, ExponentialQuotientIsSmoothThroughZeroAndTheSwitchOfForms) {
  for (const double z : {-3.0, -0.2500001, -0.2499999, -1e-3, 1e-12, 0.2499999, 0.2500001, 5.0}) {
    const long double lz = z;
    const long double f = std::expm1(lz) / lz;
    EXPECT_NEAR(exponential_quotient(z), static_cast<double>(f), 2e-15 * static_cast<double>(f)) << z;
    // derivative: integral form sum_k (k+1) z^k/(k+2)! by a long series
    long double slope = 0, term = 0.5L;
    for (int k = 0; k < 60; ++k) {
      slope += (k + 1) * term;
      term *= lz / (k + 3);
    }
    EXPECT_NEAR(exponential_quotient(Dual<1>(z, 0)).d[0], static_cast<double>(slope),
                2e-14 * std::abs(static_cast<double>(slope)))
        << z;
  }
  EXPECT_DOUBLE_EQ(exponential_quotient(0.0), 1.0);
  EXPECT_DOUBLE_EQ(exponential_quotient(Dual<1>(0.0, 0)).d[0], 0.5);
}

TEST(Dual, ConstantsHaveNoDerivative) {
  const Dual<3> c = Dual<3>(4.0) * 2.0;
  EXPECT_DOUBLE_EQ(value(c), 8.0);
  for (const double d : c.d) EXPECT_EQ(d, 0.0);
}

}  // namespace
}  // namespace mudline
