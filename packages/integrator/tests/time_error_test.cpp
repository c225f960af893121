// The estimated time error of a step against the true one, found with fine steps from the same state: size and order,
// for every integrator.
#include <gtest/gtest.h>

#include "modal_fixture.hpp"

namespace mudline {
namespace {

using testing::ModalSystem;
using testing::Mode;

/// A loaded oscillator and a pressure that decays.
Mode mode(bool inertia) {
  Mode m{inertia ? 2.0 : 0.0, inertia ? 0.3 : 0.0, 30, inertia ? 0.0 : 0.4, 0.5, 3, {}, {}};
  m.load = [inertia](double t) { return inertia ? 3 * std::sin(2 * t) + t : 1.0; };
  m.source = [](double) { return 0.0; };
  return m;
}

struct Result {
  double estimate, truth, exponent;
};

/// Estimated and true error of one field in one step after 0.4 s in steps of dt.
Result one_step(int field, const TimeScheme& scheme, double dt) {
  ModalSystem system(true, mode(scheme.inertia));
  system.start(0.1, scheme.inertia ? 0.2 : 0.0, 0.3);
  const int steps = static_cast<int>(std::lround(0.4 / dt));
  for (int i = 0; i < steps; ++i) system.measured_step(dt, dt, i, scheme);
  system.store().keep();
  const LocalError error = system.measured_step(dt, dt, steps, scheme)[field];
  const double taken = field == 0 ? system.u() : system.p();
  system.store().restore();
  TimeScheme fine;  // the trapezoidal rule; it does not use the pressure rates, which belong to another instant
  fine.inertia = scheme.inertia;
  fine.incremental = true;
  fine.theta = 0.5;
  system.run(dt, 32, fine);  // not finer: in shorter steps inertia is rounding, which takes a second iteration
  const double exact = field == 0 ? system.u() : system.p();
  return {error.ratio * ModalSystem::tolerance, std::sqrt(3.0) * std::abs(taken - exact),
          -std::log(error.ratio) / std::log(error.factor / 0.9)};
}

void check(const std::string& what, int field, const TimeScheme& scheme, int order) {
  const Result coarse = one_step(field, scheme, 0.02), fine = one_step(field, scheme, 0.01);
  EXPECT_NEAR(std::log2(coarse.estimate / fine.estimate), order + 1, 0.25) << what;
  EXPECT_NEAR(std::log2(coarse.truth / fine.truth), order + 1, 0.3) << what;
  EXPECT_NEAR(fine.estimate / fine.truth, 1, 0.2) << what;
  EXPECT_NEAR(fine.exponent, order + 1, 1e-9) << what;
}

TimeScheme theta(double theta) {
  TimeScheme s;
  s.inertia = false;
  s.incremental = true;
  s.theta = theta;
  return s;
}

TEST(TimeError, OfDisplacementsWithInertia) {
  check("trapezoidal rule", 0, TimeScheme(), 2);
  for (double radius : {0.0, 0.5, 0.8, 1.0})
    check("spectral radius " + std::to_string(radius), 0, generalised_alpha(radius), 2);
}

TEST(TimeError, OfPressuresByTheirIntegrator) {
  check("backward Euler", 1, theta(1), 1);
  check("theta 2/3", 1, theta(2.0 / 3), 1);
  check("Crank-Nicolson", 1, theta(0.5), 2);
  for (double radius : {0.5, 0.8}) check("spectral radius " + std::to_string(radius), 1, generalised_alpha(radius), 2);
}

TEST(TimeError, IsNotKnownAtTheStart) {
  ModalSystem system(true, mode(true));
  system.start(0.1, 0.2, 0.3);
  const TimeScheme scheme = generalised_alpha(0.8);
  for (int step = 0; step < 4; ++step) {
    const auto [u, p] = system.measured_step(0.01, 0.01, step, scheme);
    EXPECT_EQ(u.ratio >= 0, step >= 1) << step;
    EXPECT_EQ(p.ratio >= 0, step >= 2) << step;
  }
}

TEST(TimeError, OfDifferentStepsInARow) {
  // differences of rates use the sizes of the steps actually taken
  ModalSystem system(true, mode(false));
  system.start(0.1, 0, 0.3);
  double old = 0.002;
  for (int i = 0; i < 100; ++i) system.measured_step(0.002, old, i, theta(1));
  system.store().keep();
  const double even = system.measured_step(0.002, 0.002, 100, theta(1))[1].ratio;
  system.store().restore();
  const double longer = system.measured_step(0.004, 0.002, 100, theta(1))[1].ratio;
  EXPECT_NEAR(longer / even, 4, 0.2);
}

}  // namespace
}  // namespace mudline
