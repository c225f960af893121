// The substepping engine on a cone whose response to simple shear is known in closed form: f = (q - M p' - c)/c with
// linear elasticity, flow q - N p' (not associated, dilating), and c that hardens with plastic shear strain by H.
#include "materials/substepping.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mudline {
namespace {

struct Cone : ConstantElasticity {
  static constexpr int hardening = 1;
  static constexpr bool associated = false;
  double friction = 0.9, dilation = 0.3, strength = 5e3, modulus = 1e6;

  Cone() : ConstantElasticity{20e6, 10e6} {}

  template <class T>
  T yield(const T* stress, const T* h) const {
    T s[6];
    const T p = sym6::deviator(stress, s);
    return (square_root(1.5 * sym6::norm_squared(s) + 1e-12) - friction * p - h[0]) / strength;
  }
  template <class T>
  void flow(const T* stress, const T*, const T&, PlasticFlow<T, 1>& out) const {
    T s[6];
    sym6::deviator(stress, s);
    const T q = square_root(1.5 * sym6::norm_squared(s) + 1e-12);
    out.bulk = T(bulk);
    out.shear = T(shear);
    for (int i = 0; i < 6; ++i) {
      const T radial = (i < 3 ? 1.5 : 3.0) * s[i] / q;
      out.yield_gradient[i] = (radial + (i < 3 ? friction / 3.0 : 0.0)) / strength;
      out.flow_direction[i] = (radial + (i < 3 ? dilation / 3.0 : 0.0)) / strength;
    }
    out.hardening_gradient[0] = T(-1.0 / strength);
    out.hardening_rate[0] = T(modulus / strength);
  }
  bool admissible(const double*, const double*) const { return true; }
  bool exhausted(const double*) const { return false; }
  double hardening_scale(int, double h) const { return h; }
};

template <class T>
bool run(const Cone& cone, const double* start, double h, const T* strain, T* stress, T* hardening,
         IntegrationOptions options = {}) {
  Substepping<T, Cone> path(cone, options, strain);
  for (int i = 0; i < 6; ++i) path.stress[i] = T(start[i]);
  path.h[0] = T(h);
  const bool ok = path.integrate();
  for (int i = 0; i < 6; ++i) stress[i] = path.stress[i];
  *hardening = path.h[0];
  return ok;
}

TEST(Substepping, SimpleShearOfAConeInClosedForm) {
  const Cone cone;
  const double p0 = 10e3, start[6] = {-p0, -p0, -p0, 0, 0, 0}, strain[6] = {0, 0, 0, 0, 0, 8e-3};
  double stress[6], h;
  ASSERT_TRUE(run(cone, start, cone.strength, strain, stress, &h));
  const double q_yield = cone.friction * p0 + cone.strength, g3 = 3 * cone.shear;
  const double shear_after = strain[5] / std::sqrt(3.0) - q_yield / g3;  // equivalent shear strain beyond yield
  const double multiplier = g3 * shear_after / (g3 + cone.friction * cone.dilation * cone.bulk + cone.modulus);
  EXPECT_NEAR(std::sqrt(3.0) * stress[5], q_yield + g3 * (shear_after - multiplier), 1e-3);
  EXPECT_NEAR(sym6::mean_pressure(stress), p0 + cone.bulk * cone.dilation * multiplier, 1e-3);
  EXPECT_NEAR(h, cone.strength + cone.modulus * multiplier, 1e-3);
}

TEST(Substepping, EndsOnTheSurfaceAndConvergesWithTheTolerance) {
  const Cone cone;
  const double start[6] = {-10e3, -14e3, -9e3, 1e3, 0, 2e3}, strain[6] = {3e-3, -4e-3, 1e-3, 2e-3, -5e-3, 1e-3};
  double exact[6], stress[6], h;
  ASSERT_TRUE(run(cone, start, cone.strength, strain, exact, &h, {1e-8, 1e-12, 100000}));
  double previous = 1e300;
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
    ASSERT_TRUE(run(cone, start, cone.strength, strain, stress, &h, {tolerance, 1e-9, 1000}));
    EXPECT_LT(std::abs(cone.yield(stress, &h)), 1.001e-9);
    double error = 0.0;
    for (int i = 0; i < 6; ++i) error = std::max(error, std::abs(stress[i] - exact[i]));
    EXPECT_LT(error, tolerance * 20e3);
    EXPECT_LT(error, previous);
    previous = error;
  }
}

// In every branch (elastic, crossing, from the surface, from outside, dip into the surface) the derivatives agree with
// differences of the plain evaluation.
TEST(Substepping, DerivativesAgreeWithDifferencesInEveryBranch) {
  const Cone cone;
  const double dip_start[6] = {-10e3, -10e3, -10e3, 0, 0, 14e3 / std::sqrt(3.0)};
  const struct {
    const char* what;
    double start[6], strain[6];
  } cases[] = {{"elastic", {-10e3, -10e3, -10e3, 0, 0, 0}, {1e-4, -1e-4, 0, 1e-4, 0, 1e-4}},
               {"crossing", {-10e3, -12e3, -10e3, 0, 1e3, 0}, {1e-3, -3e-3, 5e-4, 1e-3, 0, 2e-3}},
               {"on the surface", {-10e3, -10e3, -10e3, 0, 0, dip_start[5]}, {1e-4, -2e-4, 0, 3e-4, 0, 1e-3}},
               {"outside", {-10e3, -10e3, -10e3, 0, 0, 10e3}, {1e-4, -2e-4, 0, 3e-4, 0, 1e-3}},
               {"dip", {-10e3, -10e3, -10e3, 0, 0, dip_start[5]}, {5e-4, -6e-4, 0, 2e-3, 0, -4e-4}}};
  for (const auto& c : cases) {
    Dual<6> strain[6], stress[6], h;
    double plain[6], low[6], high[6], unused;
    for (int i = 0; i < 6; ++i) strain[i] = Dual<6>(c.strain[i], i);
    ASSERT_TRUE(run(cone, c.start, cone.strength, strain, stress, &h)) << c.what;
    ASSERT_TRUE(run(cone, c.start, cone.strength, c.strain, plain, &unused)) << c.what;
    for (int j = 0; j < 6; ++j) {
      double shifted[6];
      const double step = 1e-8;
      for (int i = 0; i < 6; ++i) shifted[i] = c.strain[i] + (i == j ? step : 0.0);
      run(cone, c.start, cone.strength, shifted, high, &unused);
      shifted[j] -= 2 * step;
      run(cone, c.start, cone.strength, shifted, low, &unused);
      for (int i = 0; i < 6; ++i) {
        EXPECT_EQ(value(stress[i]), plain[i]) << c.what;
        EXPECT_NEAR(stress[i].d[j], (high[i] - low[i]) / (2 * step), 1e-6 * 30e6) << c.what << " " << i << j;
      }
    }
  }
}

TEST(Substepping, FailsWithoutNotANumberWhenItMayNotSubstep) {
  const Cone cone;
  const double start[6] = {-10e3, -10e3, -10e3, 0, 0, 6e3}, strain[6] = {0.1, -0.3, 0.05, 0.2, -0.1, 0.4};
  double stress[6], h;
  EXPECT_FALSE(run(cone, start, cone.strength, strain, stress, &h, {1e-9, 1e-9, 3}));
  double invalid[6] = {NAN, 0, 0, 0, 0, 0};
  EXPECT_FALSE(run(cone, start, cone.strength, invalid, stress, &h));
}

}  // namespace
}  // namespace mudline
