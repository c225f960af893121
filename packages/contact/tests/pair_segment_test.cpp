#include <gtest/gtest.h>

#include <cmath>

#include "contact/mortar/pair_segment.hpp"
#include "slope_friction.hpp"

namespace mudline {
namespace {

/// The slave is on top, its nodes to the right (its body above). The master is below, its nodes to the left. Quadratic
/// sides are curved.
PairCoordinates sides(double overlap, double shift, double bend) {
  PairCoordinates x;
  x.slave = {Point{0.5, -overlap}, Point{1.5, -0.7 * overlap}, Point{1.02, -overlap - bend}};
  x.master = {Point{1.9 + shift, 0.02}, Point{0.9 + shift, -0.01}, Point{1.42 + shift, 0.005 + bend}};
  return x;
}

double& entry(PairLaw& law, PairCoordinates& x, int unknown) {
  if (unknown >= 4 * law.nodes) return law.pore_pressure[unknown - 4 * law.nodes];
  return unknown < 2 * law.nodes ? x.slave[unknown / 2][unknown % 2] : x.master[unknown / 2 - law.nodes][unknown % 2];
}

constexpr Geometry flat = Geometry::plane_strain, round = Geometry::axisymmetric;

struct Case {
  const char* name;
  int nodes;
  Geometry geometry;
  double overlap, shift, friction, multiplier;
  double viscous = 0;
  int pressures = 0;
};

class EverySegment : public testing::TestWithParam<Case> {
 protected:
  EverySegment() : friction_(GetParam().friction) {
    const Case c = GetParam();
    law_.nodes = c.nodes;
    law_.geometry = c.geometry;
    law_.rule = line_quadrature(5);
    law_.penalty = 1e6;
    law_.capture = 0.5;
    if (c.friction > 0) law_.friction = &friction_;
    law_.normal[0] = c.multiplier;
    law_.normal[1] = 1.5 * c.multiplier;
    law_.shear[0] = 0.1 * c.multiplier;
    law_.viscous = c.viscous;
    law_.pressures = c.pressures;
    for (int a = 0; a < c.pressures; ++a) law_.pore_pressure[a] = 2e3 * (a + 1) - 5e3 * (a == 2);
    if (c.viscous > 0) {
      law_.start_weight = 0.4;
      law_.pressure_old[0] = 3e4;
      law_.pressure_old[1] = 1e4;
    }
    now_ = sides(c.overlap, c.shift, c.nodes == 3 ? 0.01 : 0);
    old_ = sides(c.overlap - 0.004, c.shift + 0.003, c.nodes == 3 ? 0.01 : 0);
  }
  Slope friction_;
  PairLaw law_;
  PairCoordinates now_, old_;
};

INSTANTIATE_TEST_SUITE_P(
    Contact, EverySegment,
    testing::Values(Case{"inner", 3, flat, 0.05, -0.5, 0, 0}, Case{"end", 3, flat, 0.05, 0, 0, 0},
                    Case{"multipliers", 3, flat, 0.01, -0.3, 0, 3e4}, Case{"straight", 2, flat, 0.05, 0, 0, 0},
                    Case{"axisymmetric", 3, round, 0.05, 0.1, 0, 0}, Case{"stick", 3, flat, 0.05, 0, 5, 2e4},
                    Case{"slip", 3, round, 0.05, -0.2, 0.01, 2e4}, Case{"straight slip", 2, flat, 0.05, 0, 0.01, 0},
                    Case{"damped", 3, flat, 0.05, 0, 5, 2e4, 20},
                    Case{"damped axisymmetric", 3, round, 0.05, 0.1, 0, 0, 20},
                    Case{"damped straight", 2, flat, 0.05, 0, 0.01, 0, 20},
                    Case{"slip in water", 3, round, 0.05, -0.2, 0.01, 2e4, 0, 2},
                    Case{"slip in water of all nodes", 3, flat, 0.05, 0, 0.01, 2e4, 0, 3},
                    Case{"damped slip in water", 3, flat, 0.05, 0, 0.01, 2e4, 20, 2},
                    Case{"straight slip in water", 2, flat, 0.05, 0, 0.01, 0, 0, 2},
                    Case{"stick in water", 3, flat, 0.05, 0, 5, 2e4, 0, 2}),
    [](const auto& info) {
      std::string name = info.param.name;
      for (char& c : name) c = c == ' ' ? '_' : c;
      return name;
    });

TEST_P(EverySegment, TangentIsTheDifferencedForce) {
  PairForce at, plain, plus, minus;
  ASSERT_TRUE(pair_segment(law_, old_, now_, true, at));
  ASSERT_TRUE(pair_segment(law_, old_, now_, false, plain));
  ASSERT_GT(at.sums.area, 0);
  const int dofs = 4 * law_.nodes;
  for (int a = 0; a < dofs; ++a) {
    EXPECT_EQ(at.f[a], plain.f[a]);
    EXPECT_EQ(at.damping[a], plain.damping[a]);
    EXPECT_EQ(at.damping[a] != 0, law_.viscous > 0);
  }
  // forces are so much larger per metre than per pascal that one hides the other
  const auto compare = [&](int first, int end, double h) {
    double size = 0, error = 0;
    for (int b = first; b < end; ++b) {
      entry(law_, now_, b) += h;
      pair_segment(law_, old_, now_, false, plus);
      entry(law_, now_, b) -= 2 * h;
      pair_segment(law_, old_, now_, false, minus);
      entry(law_, now_, b) += h;
      for (int a = 0; a < dofs; ++a) {
        size = std::max(size, std::abs(at.k[a][b]));
        const double weight = 1 / (1 - law_.start_weight);
        const double change = plus.f[a] - minus.f[a] + weight * (plus.damping[a] - minus.damping[a]);
        error = std::max(error, std::abs(change / (2 * h) - at.k[a][b]));
      }
    }
    EXPECT_LE(error, 1e-7 * size);
    return size;
  };
  EXPECT_GT(compare(0, dofs, 1e-6), 0);
  // what sticks does not feel the water
  const bool slides = at.sums.sliding > 0;
  EXPECT_EQ(compare(dofs, dofs + law_.pressures, 1.0) > 0, slides && law_.pressures > 0);
}

TEST_P(EverySegment, WhatTheSlaveGetsTheMasterGives) {
  PairForce at;
  ASSERT_TRUE(pair_segment(law_, old_, now_, false, at));
  double sum[2] = {0, 0}, size = 0, moment = 0;
  for (int a = 0; a < 4 * law_.nodes; ++a) {
    const double force = at.f[a] + at.damping[a];
    sum[a % 2] += force;
    size += std::abs(force);
    moment += (a % 2 ? 1 : -1) * force * entry(law_, now_, a % 2 ? a - 1 : a + 1);
  }
  EXPECT_NEAR(sum[0], 0, 1e-14 * size);
  EXPECT_NEAR(sum[1], 0, 1e-14 * size);
  // normal forces act along the line from closest point to point; shear stresses have the gap as lever arm
  if (!law_.friction) {
    EXPECT_NEAR(moment, 0, 1e-13 * size);
  }
}

TEST(PairSegment, UniformOverlapOfStraightSidesPressesOnWhatTheyShare) {
  PairLaw law;
  law.rule = line_quadrature(5);
  law.penalty = 1e6;
  law.capture = 1;
  PairCoordinates x;
  x.slave = {Point{0, -0.01}, Point{1, -0.01}, Point{0.5, -0.01}};
  x.master = {Point{2, 0}, Point{0.25, 0}, Point{1.125, 0}};
  PairForce force;
  ASSERT_TRUE(pair_segment(law, x, x, false, force));
  EXPECT_NEAR(force.sums.area, 0.75, 1e-14);
  double on_slave = 0;
  for (int a = 0; a < 3; ++a) on_slave += force.f[2 * a + 1];
  EXPECT_NEAR(on_slave, 0.75e4, 1e-9);
  EXPECT_NEAR(force.sums.deepest, -0.01, 1e-15);
  x.slave[0][1] = x.slave[1][1] = x.slave[2][1] = 0.01;  // within `capture`, but not pressed
  ASSERT_TRUE(pair_segment(law, x, x, false, force));
  EXPECT_EQ(force.sums.area, 0);
  std::swap(x.master[0], x.master[1]);  // back to back
  EXPECT_FALSE(pair_segment(law, x, x, false, force));
}

TEST(PairSegment, FrictionIsOnTheTractionLessThePorePressure) {
  struct Half : Friction {
    ShearStrength strength(const FrictionPoint& at) const override {
      return at.normal > 0 ? ShearStrength{0.5 * at.normal, 0.5} : ShearStrength{0, 0};
    }
  } half;
  PairLaw law;
  law.rule = line_quadrature(5);
  law.penalty = 1e6;
  law.capture = 1;
  law.friction = &half;
  PairCoordinates old, now;
  old.slave = now.slave = {Point{0, -0.01}, Point{1, -0.01}, Point{0.5, -0.01}};
  old.master = now.master = {Point{2, 0}, Point{-1, 0}, Point{0.5, 0}};
  for (Point& node : now.slave) node[0] += 0.1;
  const auto drag = [&] {
    PairForce force;
    EXPECT_TRUE(pair_segment(law, old, now, false, force));
    return force.f[0] + force.f[2] + force.f[4];
  };
  EXPECT_NEAR(drag(), -0.5 * 1e4, 1e-8);
  law.pressures = 2;  // from 1 to 4 kPa over the side
  law.pore_pressure[0] = 1e3;
  law.pore_pressure[1] = 4e3;
  EXPECT_NEAR(drag(), -0.5 * (1e4 - 2.5e3), 1e-8);
  law.pressures = 3;  // and 3 kPa in its middle: Simpson's rule
  law.pore_pressure[2] = 3e3;
  EXPECT_NEAR(drag(), -0.5 * (1e4 - (1e3 + 4e3 + 4 * 3e3) / 6), 1e-8);
  law.pressures = 2;  // a suction counts as much as the traction at most
  law.pore_pressure[0] = law.pore_pressure[1] = -4e3;
  EXPECT_NEAR(drag(), -0.5 * (1e4 + 4e3), 1e-8);
  law.pore_pressure[0] = law.pore_pressure[1] = -4e4;
  EXPECT_NEAR(drag(), -0.5 * 2e4, 1e-8);
  law.pore_pressure[0] = law.pore_pressure[1] = 2e4;  // more than the traction: no strength is left
  EXPECT_EQ(drag(), 0);
}

}  // namespace
}  // namespace mudline
