// Orders of accuracy of displacement and pressure in a coupled linear mode with a known motion, for every integrator.
#include <gtest/gtest.h>

#include "core/section.hpp"
#include "modal_fixture.hpp"

namespace mudline {
namespace {

using testing::ModalSystem;
using testing::Mode;

double u_exact(double t) { return std::sin(3 * t) + 0.5; }
double v_exact(double t) { return 3 * std::cos(3 * t); }
double a_exact(double t) { return -9 * std::sin(3 * t); }
double p_exact(double t) { return std::cos(2 * t) + t; }
double p_rate_exact(double t) { return -2 * std::sin(2 * t) + 1; }

/// Manufactured loads for the motion above.
Mode manufactured(bool inertia) {
  Mode m{inertia ? 2.0 : 0.0, inertia ? 0.3 : 0.0, 30, 4, 0.5, 3, {}, {}};
  m.load = [m](double t) { return m.m * a_exact(t) + m.c * v_exact(t) + m.k * u_exact(t) - m.l * p_exact(t); };
  m.source = [m](double t) { return m.l * v_exact(t) + m.s * p_rate_exact(t) + m.h * p_exact(t); };
  return m;
}

struct Errors {
  double u, p;
};

/// Largest errors over the second half of two seconds.
Errors errors(const TimeScheme& scheme, int steps) {
  ModalSystem system(true, manufactured(scheme.inertia));
  system.start(u_exact(0), v_exact(0), p_exact(0));
  Errors e{0, 0};
  const double dt = 2.0 / steps;
  for (int i = 1; i <= steps; ++i) {
    system.step(dt, scheme);
    if (2 * i < steps) continue;
    e.u = std::max(e.u, std::abs(system.u() - u_exact(i * dt)));
    e.p = std::max(e.p, std::abs(system.p() - p_exact(i * dt)));
  }
  return e;
}

void check_order(const std::string& what, const TimeScheme& scheme, double order) {
  const Errors coarse = errors(scheme, 200), fine = errors(scheme, 400);
  const double u = std::log2(coarse.u / fine.u), p = std::log2(coarse.p / fine.p);
  EXPECT_NEAR(u, order, 0.07) << what;
  EXPECT_NEAR(p, order, 0.07) << what;
  ::testing::Test::RecordProperty(what, std::to_string(u) + " " + std::to_string(p));
}

/// The scheme of an integrator that is read from a deck.
TimeScheme scheme(const std::string& type, const std::vector<std::pair<std::string, double>>& numbers = {},
                  const std::string& pressure = "") {
  Registry<TimeIntegrator> registry("integrator");
  register_time_integrators(registry);
  Teuchos::ParameterList list("integrator");
  list.set("type", type);
  for (const auto& [name, value] : numbers) list.set(name, value);
  if (!pressure.empty()) list.set("pore pressure integration", pressure);
  return registry.create(Section(list, std::make_shared<Sources>(), std::make_shared<FunctionLibrary>(), ""))
      ->scheme(100);
}

TEST(TimeOrder, GeneralisedAlphaIsSecondOrderInBothFields) {
  for (const double radius : {0.0, 0.5, 0.8, 1.0})
    check_order("radius " + std::to_string(radius), scheme("generalised alpha", {{"spectral radius", radius}}), 2);
}

TEST(TimeOrder, NewmarkIsSecondOrderOnlyWithoutDamping) {
  check_order("trapezoidal", scheme("newmark"), 2);
  check_order("gamma 0.6", scheme("newmark", {{"gamma", 0.6}, {"beta", 0.3025}}), 1);
}

TEST(TimeOrder, HilberHughesTaylorIsSecondOrder) {
  for (const double alpha : {0.05, 0.3})
    check_order("alpha " + std::to_string(alpha), scheme("hht alpha", {{"alpha", alpha}}), 2);
}

TEST(TimeOrder, PressureByThetaBesideInertia) {
  check_order("theta 0.5", scheme("generalised alpha", {{"spectral radius", 1}, {"theta", 0.5}}, "theta"), 2);
  check_order("theta 1", scheme("generalised alpha", {{"spectral radius", 1}, {"theta", 1}}, "theta"), 1);
}

TEST(TimeOrder, ThetaWithoutInertia) {
  check_order("midpoint", scheme("theta", {{"theta", 0.5}}), 2);
  check_order("backward Euler", scheme("theta", {{"theta", 1}}), 1);
}

TEST(InitialRates, FulfilBothEquations) {
  ModalSystem system(true, manufactured(true));
  system.start(u_exact(0), v_exact(0), p_exact(0));
  EXPECT_NEAR(system.a(), a_exact(0), 1e-12);
  EXPECT_NEAR(system.p_rate(), p_rate_exact(0), 1e-12);
}

TEST(InitialRates, StayZeroWhereNothingIsStored) {
  Mode mode = manufactured(true);
  mode.s = 0;
  ModalSystem system(true, mode);
  system.start(u_exact(0), v_exact(0), p_exact(0));
  EXPECT_NEAR(system.a(), a_exact(0), 1e-12);
  EXPECT_EQ(system.p_rate(), 0);
}

}  // namespace
}  // namespace mudline
