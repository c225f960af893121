// Laws whose strengths are divided by a factor, against the same laws with the smaller strengths.
#include <gtest/gtest.h>

#include <cmath>
#include <list>

#include "materials/register_materials.hpp"
#include "point_driver.hpp"

namespace mudline {
namespace {

const double degree = std::acos(-1.0) / 180.0;
constexpr double factor = 1.3;

double reduced_angle(double angle) { return std::atan(std::tan(angle * degree) / factor) / degree; }

class StrengthReduction : public testing::Test {
 protected:
  StrengthReduction() { register_materials(skeletons_, fluids_, permeabilities_); }

  std::unique_ptr<Skeleton> law(const std::string& type, const Teuchos::ParameterList& list) const {
    Teuchos::ParameterList& typed = lists_.emplace_back(list);
    typed.set("type", type);
    return skeletons_.create(Section(typed, std::make_shared<Sources>(), std::make_shared<FunctionLibrary>(), ""));
  }

  /// The law with its strengths over `factor` gives the stresses of the `weaker` one, from small strains to failure.
  void expect_same(const std::string& type, const Teuchos::ParameterList& list,
                   const Teuchos::ParameterList& weaker) const {
    SCOPED_TRACE(type);
    const auto strong = law(type, list), weak = law(type, weaker);
    EXPECT_EQ(strong->strengths(), Strengths::reducible);
    PointDriver reduced(*strong, isotropic_stress(100e3), 0.8), given(*weak, isotropic_stress(100e3), 0.8),
        whole(*strong, isotropic_stress(100e3), 0.8);
    reduced.strength_factor = factor;
    for (const double strain : {1e-6, 1e-3, 1e-2, 1e-1}) {
      const std::array<double, 6> increment{0.0, -strain, 0.4 * strain, 0.1 * strain, 0.0, 0.3 * strain};
      std::array<double, 6> one, other, larger;
      std::vector<double> state;
      ASSERT_TRUE(reduced.evaluate(increment, one, state));
      ASSERT_TRUE(given.evaluate(increment, other, state));
      ASSERT_TRUE(whole.evaluate(increment, larger, state));
      for (int c = 0; c < 6; ++c) EXPECT_NEAR(one[c], other[c], 1e-9 * 100e3) << "component " << c;
      const double q = sym6::invariants(one.data()).q, unreduced = sym6::invariants(larger.data()).q;
      if (strain < 1e-5)
        EXPECT_NEAR(q, unreduced, 1e-9 * 100e3) << "the stiffness changes";
      else if (strain > 1e-2)
        EXPECT_LT(q, 0.95 * unreduced);
    }
  }

  mutable std::list<Teuchos::ParameterList> lists_;  // laws whose numbers vary keep their section
  Registry<Skeleton> skeletons_{"skeleton"};
  Registry<Fluid> fluids_{"fluid"};
  Registry<Permeability> permeabilities_{"permeability"};
};

Teuchos::ParameterList elastic() {
  Teuchos::ParameterList list;
  list.set("Young's modulus", 2e7).set("Poisson's ratio", 0.3);
  return list;
}

/// Cohesion, friction and dilation of a sand; the cohesion is low, so that the stress stays away from the tip.
Teuchos::ParameterList frictional(double cohesion, double friction, double dilation) {
  Teuchos::ParameterList list = elastic();
  list.set("cohesion", cohesion).set("friction angle [deg]", friction).set("dilation angle [deg]", dilation);
  return list;
}

TEST_F(StrengthReduction, MohrCoulombAndDruckerPragerTakeCohesionAndTangentOfFriction) {
  for (const char* type : {"mohr-coulomb", "drucker-prager"}) {
    expect_same(type, frictional(10e3, 30.0, 8.0), frictional(10e3 / factor, reduced_angle(30.0), 8.0));
    // the dilation angle is held until the friction angle is no larger
    expect_same(type, frictional(10e3, 30.0, 28.0),
                frictional(10e3 / factor, reduced_angle(30.0), reduced_angle(30.0)));
  }
}

TEST_F(StrengthReduction, StiffnessThatGrowsWithTheStressStays) {
  Teuchos::ParameterList strong = frictional(10e3, 30.0, 0.0),
                         weak = frictional(10e3 / factor, reduced_angle(30.0), 0.0);
  strong.set("stiffness exponent", 0.5);
  weak.set("stiffness exponent", 0.5);
  expect_same("mohr-coulomb", strong, weak);
}

TEST_F(StrengthReduction, DirectConeTakesSlopeAndIntercept) {
  const auto cone = [](double slope, double intercept, double dilation) {
    Teuchos::ParameterList list = elastic();
    list.set("match", "direct").set("cone slope", slope).set("cone intercept", intercept);
    list.set("dilation slope", dilation);
    return list;
  };
  expect_same("drucker-prager", cone(0.4, 8e3, 0.39), cone(0.4 / factor, 8e3 / factor, 0.4 / factor));
}

TEST_F(StrengthReduction, TrescaTakesTheStrengthAndKeepsTheStiffnessOfItsRigidityIndex) {
  Teuchos::ParameterList strong, weak;
  strong.set("undrained strength", 40e3).set("rigidity index", 150.0).set("Poisson's ratio", 0.4);
  weak.set("undrained strength", 40e3 / factor).set("shear modulus", 150.0 * 40e3).set("Poisson's ratio", 0.4);
  for (auto* list : {&strong, &weak}) list->set("sensitivity", 3.0);
  expect_same("tresca", strong, weak);
}

TEST_F(StrengthReduction, VonMisesTakesTheYieldStressWithItsHardening) {
  const auto metal = [](double over) {
    Teuchos::ParameterList list = elastic();
    list.set("yield stress", 80e3 / over).set("hardening modulus", 2e5 / over);
    list.set("saturation stress", 3e4 / over).set("saturation rate", 40.0);
    return list;
  };
  expect_same("von mises", metal(1.0), metal(factor));
}

TEST_F(StrengthReduction, NumbersOfThePlaceAreReducedToo) {
  Teuchos::ParameterList varied = frictional(10e3, 30.0, 8.0);
  varied.set("friction angle [deg]", "30 + 2*x").set("cohesion", "10e3 + 5e3*x");
  expect_same("mohr-coulomb", varied, frictional(10e3 / factor, reduced_angle(30.0), 8.0));  // the point lies at x = 0
}

TEST_F(StrengthReduction, LawsSayWhetherTheyHaveStrengths) {
  Teuchos::ParameterList list = elastic();
  for (const char* type : {"linear elastic", "neo-hookean"}) EXPECT_EQ(law(type, list)->strengths(), Strengths::none);
  Teuchos::ParameterList clay;
  clay.set("critical stress ratio", 1.1).set("compression slope", 0.18).set("swelling slope", 0.03);
  clay.set("Poisson's ratio", 0.25);
  EXPECT_EQ(law("modified cam clay", clay)->strengths(), Strengths::unknown);
}

}  // namespace
}  // namespace mudline
