// Contact laws that say their slopes, and laws that say others.
#include "contact/laws/slope_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mudline {
namespace {

/// strength = 0.4 normal^0.9 (1 + rate) (1 - u/1e7), with factors that spoil one slope each.
struct Interface : Friction {
  double normal = 1, rate = 1, pore = 1;
  ShearStrength strength(const FrictionPoint& at) const override {
    const double u = at.soil.pore_pressure, wet = 1 - u / 1e7, base = 0.4 * std::pow(at.normal, 0.9);
    return {base * (1 + at.rate) * wet, normal * 0.9 * base / at.normal * (1 + at.rate) * wet, rate * base * wet,
            -pore * base * (1 + at.rate) / 1e7};
  }
  SoilQuantities reads() const override { return {true, false, false}; }
};

/// Quadratic, softer in wet soil.
struct Cushion : NormalLaw {
  double depth = 1, pore = 1;
  NormalPressure at(double penetration, double stiffness, const TouchingSoil& soil) const override {
    const double wet = 1 - soil.pore_pressure / 1e6;
    return {stiffness * penetration * penetration * wet, depth * 2 * stiffness * penetration * wet,
            -pore * stiffness * penetration * penetration / 1e6};
  }
  SoilQuantities reads() const override { return {true, false, false}; }
};

TEST(SlopeCheck, PassesLawsWithTheirSlopes) {
  EXPECT_EQ(slope_problem(Interface()), "");
  EXPECT_EQ(slope_problem(Cushion()), "");
  EXPECT_EQ(slope_problem(LinearNormalLaw()), "");
}

TEST(SlopeCheck, NamesTheSlopeThatIsWrong) {
  for (const double factor : {0.0, -1.0, 0.98, 2.0, std::nan("")}) {
    Interface interface;
    interface.normal = factor;
    EXPECT_EQ(slope_problem(interface).find("d strength / d normal is "), 0u) << factor;
    interface = Interface();
    interface.rate = factor;
    EXPECT_EQ(slope_problem(interface).find("d strength / d rate [Pa s/m] is "), 0u) << factor;
    interface = Interface();
    interface.pore = factor;
    EXPECT_EQ(slope_problem(interface).find("d strength / d pore pressure is "), 0u) << factor;
    Cushion cushion;
    cushion.depth = factor;
    EXPECT_EQ(slope_problem(cushion).find("d pressure / d penetration [Pa/m] is "), 0u) << factor;
    cushion = Cushion();
    cushion.pore = factor;
    EXPECT_EQ(slope_problem(cushion).find("d pressure / d pore pressure is "), 0u) << factor;
  }
}

/// A cap that is reached where the law is asked: either side will do.
struct Kink : Friction {
  ShearStrength strength(const FrictionPoint& at) const override {
    return at.normal < 5e4 ? ShearStrength{0.4 * at.normal, 0.4} : ShearStrength{2e4, 0};
  }
};

TEST(SlopeCheck, AllowsKinks) { EXPECT_EQ(slope_problem(Kink()), ""); }

}  // namespace
}  // namespace mudline
