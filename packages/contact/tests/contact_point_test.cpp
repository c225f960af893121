#include "contact/laws/contact_point.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "reading_laws.hpp"
#include "slope_friction.hpp"

namespace mudline {
namespace {

constexpr int inputs = 9;
using Numbers = std::array<double, inputs>;

/// The numbers of a motion that carry derivatives, in this order.
template <class T>
std::array<T*, inputs> numbers(ContactMotion<T>& m) {
  return {&m.gap, &m.shift, &m.gap_old, &m.force_old, &m.area, &m.travel, &m.opened, &m.shear_old, &m.pore_pressure};
}

struct Case {
  const char* name;
  bool presses, slides;
  std::function<void(ContactPointLaw&, ContactMotion<double>&)> set;
};

Slope slope(0.3);

/// Sets a point that is pressed by 1 cm and dragged by 1 mm.
void usual(ContactPointLaw& law, ContactMotion<double>& m) {
  law.penalty = 1e6;
  law.dt = 0.5;
  law.start_weight = 0.4;
  law.friction = &slope;
  m.gap = -0.01;
  m.gap_old = -0.007;
  m.force_old = 4e3;
  m.area = 0.7;
  m.travel = 1e-3;
  m.shear_old = 300;
  m.pore_pressure = 2e3;
}

const Case cases[] = {
    {"Open", false, false, [](ContactPointLaw&, auto& m) { m.gap = 0.002; }},
    {"Stick", true, false, [](ContactPointLaw&, auto&) {}},
    {"Slide", true, true, [](ContactPointLaw&, auto& m) { m.travel = 0.02; }},
    {"SlideBack", true, true, [](ContactPointLaw&, auto& m) { m.travel = -0.02; }},
    {"Touched", true, false,
     [](ContactPointLaw&, auto& m) {
       m.opened = m.gap_old = 0.03;
       m.shear_old = 0;
     }},
    {"TouchedAndSlides", true, true,
     [](ContactPointLaw&, auto& m) {
       m.opened = m.gap_old = 0.03;
       m.travel = 0.03;
     }},
    {"FirstGuess", true, false,
     [](ContactPointLaw& law, auto& m) {
       law.first_guess = true;
       m.travel = 0.02;
     }},
    {"FirstGuessSlid", true, true,
     [](ContactPointLaw& law, auto& m) {
       law.first_guess = true;
       m.slid = true;
     }},
    {"DampedClosing", true, false, [](ContactPointLaw& law, auto&) { law.viscous = 3; }},
    {"DampedParting", true, true,
     [](ContactPointLaw& law, auto& m) {
       law.viscous = 3;
       m.gap = -0.003;
     }},
    {"DampedToNothing", true, false,
     [](ContactPointLaw& law, auto& m) {
       law.viscous = 3e3;
       m.gap_old = -0.02;
     }},
    {"DampedAndLeft", false, false,
     [](ContactPointLaw& law, auto& m) {
       law.viscous = 3;
       m.gap = 0.002;
     }},
    {"ConservingTouch", true, false,
     [](ContactPointLaw& law, auto& m) {
       law.conserves = true;
       law.viscous = 3;
       law.impact_damping = 0.1;
       m.gap_old = m.opened = 0.004;
     }},
    {"ConservingLeave", false, false,
     [](ContactPointLaw& law, auto& m) {
       law.conserves = true;
       law.viscous = 3;
       law.impact_damping = 0.1;
       m.gap = 0.004;
     }},
    {"Multiplier", true, false,
     [](ContactPointLaw&, auto& m) {
       m.gap = 0.002;
       m.shift = 0.015;
     }},
    {"Touch", true, true,
     [](ContactPointLaw& law, auto& m) {
       law.touch = 1e-3;
       m.gap = 5e-4;
       m.pore_pressure = -500;
     }},
};

class EveryPoint : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(ContactPoint, EveryPoint, testing::ValuesIn(cases),
                         [](const auto& info) { return std::string(info.param.name); });

template <class T>
std::array<T, 5> results(const ContactResponse<T>& r) {
  return {r.pressure, r.shear, r.damping, r.start_share, r.end_share};
}

void expect_differences(const ContactPointLaw& law, ContactMotion<double> motion) {
  using T = Dual<inputs>;
  ContactMotion<T> dual;
  dual.slid = motion.slid;
  dual.slip_old = motion.slip_old;
  dual.soil = motion.soil;
  for (int i = 0; i < inputs; ++i) *numbers(dual)[i] = T(*numbers(motion)[i], i);
  const auto exact = results(respond(law, dual));
  const auto plain = results(respond(law, motion));
  for (int k = 0; k < 5; ++k) EXPECT_EQ(exact[k].v, plain[k]) << k;
  for (int i = 0; i < inputs; ++i) {
    double& x = *numbers(motion)[i];
    if (&x == &motion.opened && x == 0) continue;  // the travel has a kink there
    const double at = x, h = 1e-6 * std::max(std::abs(at), 1e-3);
    x = at + h;
    const auto plus = results(respond(law, motion));
    x = at - h;
    const auto minus = results(respond(law, motion));
    x = at;
    for (int k = 0; k < 5; ++k)
      EXPECT_NEAR(exact[k].d[i], (plus[k] - minus[k]) / (2 * h),
                  1e-6 * std::abs(exact[k].d[i]) + 1e-13 * std::abs(plain[k]) / h)
          << "result " << k << " by input " << i;
  }
}

TEST_P(EveryPoint, DerivativesAreDifferences) {
  ContactPointLaw law;
  ContactMotion<double> motion;
  usual(law, motion);
  GetParam().set(law, motion);
  const ContactResponse<double> now = respond(law, motion);
  EXPECT_EQ(now.presses, GetParam().presses);
  EXPECT_EQ(now.slides, GetParam().slides);
  if (std::string(GetParam().name) == "Touch") return;  // between the branches of the law: stiffness without force
  expect_differences(law, motion);
}

TEST(ContactPoint, HasStiffnessButNoForceWhereSurfacesMeet) {
  ContactPointLaw law;
  ContactMotion<Dual<1>> motion;
  law.penalty = 1e6;
  law.touch = 1e-3;
  motion.gap = Dual<1>(5e-4, 0);
  const auto now = respond(law, motion);
  EXPECT_TRUE(now.presses);
  EXPECT_EQ(now.pressure.v, 0);
  EXPECT_EQ(now.pressure.d[0], -1e6);
}

TEST(ContactPoint, WhatTurnedHasTheStiffnessOfASecant) {
  ContactPointLaw law;
  ContactMotion<double> m;
  usual(law, m);
  m.travel = 0.02;
  m.shear_old = 0;
  using Number = Dual<1>;
  const auto shear = [&](bool turned) {
    law.turned = turned;
    ContactMotion<Number> seeded;
    seeded.gap = m.gap;
    seeded.travel = Number(m.travel, 0);
    seeded.pore_pressure = m.pore_pressure;
    return respond<Number, 2>(law, seeded).shear;
  };
  const Number along = shear(false), turned = shear(true);
  EXPECT_DOUBLE_EQ(turned.v, along.v);
  EXPECT_LT(turned.v, 0);
  EXPECT_NEAR(turned.d[0] - along.d[0], turned.v / m.travel, 1e-9 * std::abs(turned.d[0]));
}

TEST(ContactPoint, HeatIsShearTimesSlip) {
  ContactPointLaw law;
  ContactMotion<double> m;
  usual(law, m);
  m.travel = 0.02;
  const auto now = respond(law, m);
  const double rate = 0.02 / law.dt, strength = 0.3 * (1 - 10 * rate) * (1e4 - 2e3);
  EXPECT_NEAR(now.shear, -strength, 1e-9);
  EXPECT_NEAR(now.slip, 0.02 - (strength + 300) / 1e6, 1e-12);
  EXPECT_NEAR(now.heat, strength * now.slip * 0.7, 1e-9);
}

TEST(ContactPoint, LawsSeeTheSoil) {
  ContactPointLaw law;
  ContactMotion<double> motion;
  usual(law, motion);
  ReadingFriction friction;
  ReadingNormalLaw pressure;
  friction.normal = 0.1;
  friction.pore = 0.02;
  friction.degree = 4;
  friction.mean = 0.003;
  friction.slip = 50;
  pressure.pore = 0.5;
  law.friction = &friction;
  law.normal_law = &pressure;
  motion.travel = 0.02;
  motion.slip_old = 0.3;
  motion.soil.temperature = 12;
  motion.soil.mean_stress = 5e4;
  const auto now = respond(law, motion);
  EXPECT_NEAR(now.pressure, 1e4 + 0.5 * 2e3, 1e-9);
  EXPECT_NEAR(now.shear, -(0.1 * (1.1e4 - 2e3) + 0.02 * 2e3 + 4 * 12 + 0.003 * 5e4 + 50 * 0.3), 1e-9);
  expect_differences(law, motion);
  // a quantity that no law reads is NaN
  motion.soil = TouchingSoil();
  EXPECT_TRUE(std::isnan(respond(law, motion).shear));
}

}  // namespace
}  // namespace mudline
