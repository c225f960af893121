// Reference of Newton's residual: the forces that act in the step, not lasting ones, with a floor from rounding.
#include <gtest/gtest.h>

#include "modal_fixture.hpp"

namespace mudline {
namespace {

using testing::ModalSystem;
using testing::Mode;

TimeScheme without_inertia() {
  TimeScheme s;
  s.inertia = false;
  s.incremental = true;
  return s;
}

constexpr double weight = 1e9;

/// Springs under a weight, with an additional load of 1e-7 of the weight.
Mode weighted() {
  Mode m;
  m.m = 0;
  m.k = 1e6;
  m.load = [](double t) { return weight + (t > 0.5 ? 100.0 : 0.0); };
  return m;
}

TEST(Reference, IsNotTheWeightThatStandsThere) {
  ModalSystem system(false, weighted());
  system.start_raw(weight / 1e6, 0, 0);
  const StepReport report = system.attempt(1, without_inertia());
  ASSERT_TRUE(report.converged) << report.reason;
  EXPECT_EQ(report.newton_iterations, 1) << "against the weight the load would be within the tolerance";
  system.store().accept();
  EXPECT_NEAR(system.u() - weight / 1e6, 100 / 1e6, 1e-6 * 100 / 1e6 + 1e-12);
}

TEST(Reference, AtRestAStepConvergesAtOnce) {
  ModalSystem system(false, weighted());
  system.start_raw(weight / 1e6 * (1 + 1e-15), 0, 0);  // equilibrium up to rounding
  for (int i = 0; i < 3; ++i) {
    const StepReport report = system.attempt(0.1, without_inertia());
    ASSERT_TRUE(report.converged) << report.reason;
    EXPECT_LE(report.newton_iterations, 1);
    system.store().accept();
  }
}

TEST(Reference, UniformMotionHasTheRoundingOfItsInertia) {
  Mode m;
  m.k = 0;
  m.m = 1e5;
  ModalSystem system(false, m);
  system.start_raw(1e3, 7.3, 0);
  for (int i = 0; i < 20; ++i) {
    const StepReport report = system.attempt(1e-4, TimeScheme());
    ASSERT_TRUE(report.converged) << i << ": " << report.reason;
    EXPECT_LE(report.newton_iterations, 2);
    system.store().accept();
  }
  EXPECT_NEAR(system.u(), 1e3 + 7.3 * 20e-4, 1e-9);
}

TEST(Reference, AFieldThatStandsOffZeroHasTheRoundingOfItsFlow) {
  Mode m;  // the source keeps the pressure constant
  m.m = 0;
  m.s = 2e6;
  m.h = 3;
  m.source = [](double) { return 30.0; };
  ModalSystem system(true, m);
  system.start(0, 0, 10);
  for (int i = 0; i < 5; ++i) {
    const StepReport report = system.attempt(1e3, without_inertia());
    ASSERT_TRUE(report.converged) << report.reason;
    EXPECT_LE(report.newton_iterations, 1);
    system.store().accept();
  }
  EXPECT_NEAR(system.p(), 10, 1e-12);
}

TEST(Reference, ATangentBeyondAllBoundsExcusesNoResidual) {
  Mode m;
  m.m = 0;
  m.k = 1e6;
  m.load = [](double t) { return 1e3 * (1 + t); };
  ModalSystem system(false, m);
  system.start_raw(1e-3, 0, 0);
  system.step(1, without_inertia());
  system.mode.tangent = 1e30;  // like the tangent of a law at an absurd strain
  NewtonOptions newton = ModalSystem::newton();
  newton.reuse_jacobian = false;
  EXPECT_FALSE(system.attempt(1, without_inertia(), newton).converged)
      << "1e30 N/m times the rounding of 2 mm is no excuse";
  system.mode.tangent = 0;
  system.step(1, without_inertia());
  EXPECT_NEAR(system.u(), 3e-3, 1e-12);
}

}  // namespace
}  // namespace mudline
