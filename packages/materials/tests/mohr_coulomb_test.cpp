// Mohr-Coulomb and Drucker-Prager against closed forms. c = 10 kPa, phi = 30 deg unless said; exact strengths by the
// Mohr circle: s1 = s3 N + 2 c sqrt(N), N = (1 + sin phi)/(1 - sin phi).
#include "materials/skeleton/mohr_coulomb.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "materials/skeleton/drucker_prager.hpp"
#include "point_driver.hpp"

namespace mudline {
namespace {

const double degree = std::acos(-1.0) / 180.0;
using Law = PointwiseSkeleton<AutomaticTangent<MohrCoulomb>>;
using ConeLaw = PointwiseSkeleton<AutomaticTangent<DruckerPrager>>;
using Method = IntegrationOptions::Method;

MohrCoulomb soil(double dilation = 0.0, double friction = 30.0) {
  MohrCoulomb law;
  law.cohesion.value = 10e3;
  law.friction = friction;
  law.dilation = dilation;
  law.apex = 1e-3;
  return law;
}

/// The rounded surface on a triaxial path at constant radial stress: sqrt(q^2 K^2/3 + m^2) = (r +- q/3) sin phi + c cos
/// phi, solved for q >= 0; upper sign compression. Compression positive.
double rounded_q(const MohrCoulomb& law, double radial, double sign) {
  const double sine = std::sin(law.friction * degree), strength = law.cohesion.value * std::cos(law.friction * degree);
  const LodeShape shape = LodeShape::mohr_coulomb(sine, law.transition);
  const double k = LodeAngle(-sign, shape.edge)(shape).k, m = law.apex * strength;
  const double a = k * k / 3 - sine * sine / 9, b = -2 * sign * sine / 3 * (radial * sine + strength);
  const double c = m * m - std::pow(radial * sine + strength, 2);
  return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

double axial_at_failure(const MohrCoulomb& parameters, double radial, double axial_strain) {
  const Law law(parameters);
  PointDriver point(law, {-radial, -radial - 1.0, -radial, 0, 0, 0}, 0.8);
  compress(point, Path::drained, axial_strain, 40);
  return -point.stress()[1];
}

TEST(MohrCoulomb, TriaxialStrengthIsThatOfTheRoundedSurface) {
  for (const Method method : {Method::implicit, Method::modified_euler, Method::dormand_prince})
    for (const double dilation : {0.0, 12.0, 30.0}) {
      MohrCoulomb law = soil(dilation);
      law.integration.method = method;
      law.integration.stress_tolerance =
          method == Method::modified_euler
              ? 1e-6
              : 1e-10;  // the driver's iteration stalls where the number of substeps changes
      law.integration.yield_tolerance = 1e-12;
      SCOPED_TRACE(testing::Message() << "method " << static_cast<int>(method) << " dilation " << dilation);
      const double compression = 100e3 + rounded_q(law, 100e3, 1.0), extension = 100e3 - rounded_q(law, 100e3, -1.0);
      EXPECT_NEAR(axial_at_failure(law, 100e3, 0.1), compression, 1e-6 * compression);
      EXPECT_NEAR(axial_at_failure(law, 100e3, -0.1), extension, 1e-6 * 100e3);
      if (method != Method::implicit) continue;  // the driver is too strict for the others near zero stress
      const double uniaxial = rounded_q(law, 0.0, 1.0);
      EXPECT_NEAR(axial_at_failure(law, 0.0, 0.1), uniaxial, 1e-6 * uniaxial);
    }
}

TEST(MohrCoulomb, TheRoundedStrengthTendsToTheExactOne) {
  double previous = 1.0;
  for (const double transition : {25.0, 28.0, 29.0, 29.9}) {
    MohrCoulomb law = soil();
    law.transition = transition;
    const double error = 1.0 - (100e3 + rounded_q(law, 100e3, 1.0)) / 334.641016e3;
    EXPECT_GT(error, 0.0);
    EXPECT_LT(error, previous);
    previous = error;
  }
  EXPECT_LT(previous, 2e-3);
  MohrCoulomb law = soil();
  law.transition = 29.9;
  EXPECT_NEAR(axial_at_failure(law, 100e3, -0.1), 21.786328e3, 2e-3 * 21.8e3);
  EXPECT_NEAR(axial_at_failure(law, 0.0, 0.1), 34.641016e3, 2e-3 * 34.6e3);
}

// In plane strain the stress is on a face of the hexagon, where nothing is rounded but the tip.
TEST(MohrCoulomb, PassivePressureIsExact) {
  for (const double dilation : {0.0, 30.0}) {
    const Law law(soil(dilation));
    PointDriver point(law, isotropic_stress(50e3), 0.8);
    for (int i = 0; i < 40; ++i) point.step({-1e-3, 0, 0, 0, 0, 0}, {false, true, false, false, false, false});
    EXPECT_NEAR(-point.stress()[0], 184.641016e3, 1e-6 * 184.6e3);
  }
}

TEST(MohrCoulomb, DilationIsThatOfTheDilationAngle) {
  for (const double dilation : {0.0, 10.0, 20.0}) {
    const Law law(soil(dilation));
    PointDriver point(law, isotropic_stress(50e3), 0.8);
    const auto push = [&] { point.step({-1e-3, 0, 0, 0, 0, 0}, {false, true, false, false, false, false}); };
    for (int i = 0; i < 40; ++i) push();
    const auto before = point.strain();
    push();
    const double x = point.strain()[0] - before[0], y = point.strain()[1] - before[1];
    EXPECT_NEAR((x + y) / (y - x), std::sin(dilation * degree), 1e-4);
  }
}

TEST(MohrCoulomb, TriaxialDilationIsThatOfTheRoundedPotential) {
  const MohrCoulomb parameters = soil(15.0);
  const Law law(parameters);
  PointDriver point(law, isotropic_stress(100e3), 0.8);
  compress(point, Path::drained, 0.1, 40);
  const auto before = point.strain();
  compress(point, Path::drained, 1e-3, 1);
  const double axial = point.strain()[1] - before[1], radial = point.strain()[0] - before[0];
  const double sine = std::sin(15 * degree);
  const LodeShape shape = LodeShape::mohr_coulomb(sine, parameters.transition);
  const double k = LodeAngle(-1.0, shape.edge)(shape).k;
  EXPECT_NEAR((axial + 2 * radial) / (2.0 / 3 * (radial - axial)), std::sqrt(3.0) * sine / k, 1e-4);
}

TEST(MohrCoulomb, UndrainedStrengthWithoutDilationIsThatOfTheStart) {
  const Law law(soil());
  PointDriver point(law, isotropic_stress(100e3), 0.8);
  for (int i = 0; i < 50; ++i) point.step({1e-3, -1e-3, 0, 0, 0, 0});
  const double radius = 0.5 * (point.stress()[0] - point.stress()[1]);
  EXPECT_NEAR(radius, 10e3 * std::cos(30 * degree) + 100e3 * 0.5, 1e-6 * 58.7e3);
}

TEST(MohrCoulomb, LargestPrincipalStressStaysBelowTheTensileStrength) {
  for (const double tensile : {0.0, 2e3, 1e300})
    for (const double dilation : {0.0, 30.0}) {
      MohrCoulomb parameters = soil(dilation);
      parameters.tensile = tensile;
      parameters.apex = 0.05;
      const Law law(parameters);
      const double limit = std::min(tensile, 2 * 10e3 * std::cos(30 * degree) / 1.5);
      PointDriver isotropic(law, isotropic_stress(20e3), 0.8), uniaxial(law, isotropic_stress(20e3), 0.8);
      for (int i = 0; i < 20; ++i) isotropic.step({1e-3, 1e-3, 1e-3, 0, 0, 0});
      EXPECT_NEAR(-isotropic.p(), limit - 0.05 * 10e3 * std::cos(30 * degree), 1e-3);
      for (int i = 0; i < 20; ++i) uniaxial.step({2e-4, 1e-3, -4e-4, 3e-4, 0, 5e-4});
      double principal[3];
      sym6::principal_values(uniaxial.stress().data(), principal);
      EXPECT_LE(principal[0], limit);
    }
}

TEST(MohrCoulomb, CohesionGrowsWithDepthAndStaysWithTheMaterial) {
  MohrCoulomb law = soil();
  law.cohesion.gradient = 2e3;
  law.cohesion.elevation = 3.0;
  InitialPoint point{};
  double state[MohrCoulomb::state_size];
  for (const double y : {5.0, 3.0, -1.0}) {
    point.position = {0, 7, -y};
    point.height = y;
    EXPECT_EQ(law.initialise(point, state), "");
    EXPECT_DOUBLE_EQ(state[MohrCoulomb::cohesion_here], 10e3 + 2e3 * std::max(0.0, 3.0 - y));
  }
  law.cohesion.value = 0.0;
  point.height = 3.0;
  EXPECT_NE(law.initialise(point, state).find("cohesion is zero"), std::string::npos);
}

TEST(MohrCoulomb, StiffnessGrowsWithThePressure) {
  // isotropic compression: dp' = K_ref ((p' + t)/(p_ref + t))^n deps_v with t = c cot(phi), so (p' + t)^(1 - n) grows
  // linearly
  MohrCoulomb parameters = soil();
  parameters.exponent = 0.6;
  parameters.reference_pressure = 80e3;
  parameters.prepare();
  const double bulk = parameters.elasticity.moduli().bulk, tip = 10e3 / std::tan(30.0 * degree), strain = 5e-3,
               start = 50e3;
  const double grown = std::pow(start + tip, 0.4) + 0.4 * bulk * strain / std::pow(80e3 + tip, 0.6);
  const double exact = std::pow(grown, 1.0 / 0.4) - tip;
  double error[2];
  for (int fine = 0; fine < 2; ++fine) {
    const Law law(parameters);
    PointDriver point(law, {-start, -start, -start, 0, 0, 0}, 0.8);
    const int steps = fine ? 400 : 200;
    for (int i = 0; i < steps; ++i)
      point.step({-strain / 3 / steps, -strain / 3 / steps, -strain / 3 / steps, 0, 0, 0});
    error[fine] = point.p() - exact;
  }
  EXPECT_NEAR(error[1], 0.0, 1e-3 * (exact - start));
  EXPECT_NEAR(error[0] / error[1], 2.0, 0.05);  // the stiffness is that at the start of a step: first order
  const double state[MohrCoulomb::state_size] = {10e3, 0.0};
  const double stress[6] = {-80e3, -80e3, -80e3, 0, 0, 0}, tension[6] = {1e3, 1e3, 1e3, 0, 0, 0};
  EXPECT_DOUBLE_EQ(parameters.moduli(stress, 0.8, state).shear, parameters.elasticity.moduli().shear);
  EXPECT_NEAR(parameters.moduli(tension, 0.8, state).shear,
              parameters.elasticity.moduli().shear * std::pow(tip / (80e3 + tip), 0.6), 1.0);
}

TEST(MohrCoulomb, LargeSimpleShearKeepsTheStressOnTheSurface) {
  for (const Method method : {Method::implicit, Method::modified_euler}) {
    MohrCoulomb parameters = soil(5.0);
    parameters.integration.method = method;
    parameters.integration.stress_tolerance = 1e-8;
    parameters.integration.maximum_substeps = 100000;
    parameters.integration.yield_tolerance = 1e-12;
    parameters.prepare();
    const Law law(parameters);
    PointDriver point(law, {-100e3, -100e3, -100e3, 0, 0, 0}, 0.8);
    double worst = 0.0;
    for (int i = 0; i < 500; ++i) {  // to a shear strain of 5 under constant vertical stress
      point.step({0, 0, 0, 0, 0, 1e-2}, {false, true, false, false, false, false});
      const double h[1] = {point.state()[1]};
      worst = std::max(worst, std::abs(parameters.model(10e3, point.stress().data()).yield(point.stress().data(), h)));
    }
    EXPECT_LT(worst, 1e-9);
    EXPECT_NEAR(point.stress()[1], -100e3, 1.0);
    EXPECT_GT(point.state()[1], 2.0);
  }
}

TEST(DruckerPrager, PlaneStrainMatchCollapsesAsMohrCoulomb) {
  for (const double dilation : {0.0, 10.0, 30.0}) {
    DruckerPrager parameters;
    parameters.friction = 30;
    parameters.dilation = dilation;
    parameters.cohesion = 10e3;
    parameters.apex = 1e-3;
    const ConeLaw law(parameters);
    PointDriver point(law, isotropic_stress(50e3), 0.8);
    for (int i = 0; i < 400; ++i) point.step({-1e-3, 0, 0, 0, 0, 0}, {false, true, false, false, false, false});
    EXPECT_NEAR(-point.stress()[0], 184.641016e3, 1e-5 * 184.6e3) << dilation;
    const auto before = point.strain();
    point.step({-1e-3, 0, 0, 0, 0, 0}, {false, true, false, false, false, false});
    const double x = point.strain()[0] - before[0], y = point.strain()[1] - before[1];
    EXPECT_NEAR((x + y) / (y - x), std::sin(dilation * degree), 1e-4);
  }
}

TEST(DruckerPrager, TriaxialMatchesMeetTheHexagon) {
  for (const bool compression : {true, false}) {
    DruckerPrager parameters;
    parameters.match = compression ? DruckerPrager::Match::compression : DruckerPrager::Match::extension;
    parameters.friction = 30;
    parameters.cohesion = 10e3;
    parameters.apex = 1e-3;
    const ConeLaw law(parameters);
    PointDriver point(law, isotropic_stress(100e3), 0.8);
    compress(point, Path::drained, compression ? 0.1 : -0.1, 40);
    EXPECT_NEAR(-point.stress()[1], compression ? 334.641016e3 : 21.786328e3, 1e-6 * 334e3);
  }
}

}  // namespace
}  // namespace mudline
