// A damped oscillator through the stepper against the published algorithm (Chung and Hulbert, J. Appl. Mech. 60, 1993,
// 371): errors of a forced vibration, and the spectral properties of one step.
#include <gtest/gtest.h>

#include <Teuchos_LAPACK.hpp>

#include <complex>

#include "modal_fixture.hpp"

namespace mudline {
namespace {

using testing::ModalSystem;
using testing::Mode;

constexpr double pi = 3.14159265358979323846;

Mode forced() {
  Mode mode;
  mode.k = 4 * pi * pi;
  mode.c = 2 * 0.05 * 2 * pi;
  mode.load = [](double t) { return 10 * std::sin(5 * t); };
  return mode;
}

/// Displacement after `steps` of the scheme, written for the acceleration as the only unknown.
double algorithm(const Mode& m, const TimeScheme& s, double d, double v, double duration, int steps) {
  const double dt = duration / steps, af = s.alpha_f, am = s.alpha_m;
  double a = (m.load(0) - m.c * v - m.k * d) / m.m;
  for (int i = 0; i < steps; ++i) {
    const double d_free = d + dt * v + dt * dt * (0.5 - s.beta) * a, v_free = v + dt * (1 - s.gamma) * a;
    const double stiff = (1 - am) * m.m + (1 - af) * (m.c * s.gamma * dt + m.k * s.beta * dt * dt);
    const double old = am * m.m * a + af * (m.c * v + m.k * d);
    const double force = m.load((i + 1 - af) * dt) - old - (1 - af) * (m.c * v_free + m.k * d_free);
    a = force / stiff;
    d = d_free + s.beta * dt * dt * a;
    v = v_free + s.gamma * dt * a;
  }
  return d;
}

TEST(Oscillator, ForcedVibrationHasThePublishedErrors) {
  const double exact = 0.37494178;
  const struct {
    double radius, errors[3];
  } cases[] = {{0, {0.0241856, 0.00720083, 0.00191679}},
               {0.5, {0.00819755, 0.00210104, 0.000529958}},
               {0.8, {0.00583674, 0.00147213, 0.000368864}},
               {1, {0.00551832, 0.00139079, 0.000348398}}};
  for (const auto& c : cases)
    for (int i = 0; i < 3; ++i) {
      const int steps = 100 << i;
      const TimeScheme scheme = generalised_alpha(c.radius);
      ModalSystem system(false, forced());
      system.start(1, 0);
      system.run(2, steps, scheme);
      EXPECT_NEAR(std::abs(system.u() - exact), c.errors[i], 1e-6) << "radius " << c.radius << ", steps " << steps;
      EXPECT_NEAR(system.u(), algorithm(system.mode, scheme, 1, 0, 2, steps), 1e-11);
      EXPECT_EQ(system.u(0), system.u(2));
    }
}

struct Spectrum {
  double radius, damping, period_error;
};

/// Spectrum of the amplification matrix of (d, dt v, dt^2 a) of the undamped oscillator, built column by column.
Spectrum spectrum(const TimeScheme& scheme, double step_over_period) {
  Mode mode;
  mode.k = 4 * pi * pi;
  const double dt = step_over_period;
  double matrix[9], real[3], imaginary[3], work[64];
  for (int j = 0; j < 3; ++j) {
    ModalSystem system(false, mode);
    system.start_raw(j == 0 ? 1 : 0, j == 1 ? 1 / dt : 0, j == 2 ? 1 / (dt * dt) : 0);
    system.step(dt, scheme);
    matrix[3 * j] = system.u();
    matrix[3 * j + 1] = dt * system.v();
    matrix[3 * j + 2] = dt * dt * system.a();
  }
  int info;
  Teuchos::LAPACK<int, double>().GEEV('N', 'N', 3, matrix, 3, real, imaginary, nullptr, 1, nullptr, 1, work, 64, &info);
  Spectrum s{0, 0, 0};
  std::complex<double> principal;
  for (int i = 0; i < 3; ++i) {
    const std::complex<double> root(real[i], imaginary[i]);
    s.radius = std::max(s.radius, std::abs(root));
    if (root.imag() > principal.imag()) principal = root;
  }
  const double angle = std::arg(principal);
  s.damping = -std::log(std::abs(principal)) / angle;
  s.period_error = 2 * pi * dt / angle - 1;
  return s;
}

TEST(Oscillator, OneStepHasThePublishedSpectrum) {
  const struct {
    double radius, spectral_radius, damping, period_error;
  } cases[] = {{0, 0.969708, 0.0549879, 0.123206},
               {0.5, 0.997733, 0.00378005, 0.0467153},
               {0.8, 0.999904, 0.000157272, 0.0338284},
               {1, 1, 0, 0.0320749}};
  for (const auto& c : cases) {
    const Spectrum s = spectrum(generalised_alpha(c.radius), 0.1);
    EXPECT_NEAR(s.radius, c.spectral_radius, 1e-6);
    EXPECT_NEAR(s.damping, c.damping, 1e-7);
    EXPECT_NEAR(s.period_error, c.period_error, 1e-6);
    EXPECT_NEAR(spectrum(generalised_alpha(c.radius), 1e4).radius, c.radius, 2e-3) << "at infinite frequency";
  }
}

TEST(Oscillator, SmallStepsFollowTheExpansion) {
  for (const double radius : {0.0, 0.5, 0.8, 1.0}) {
    const double y = (1 - radius) / (1 + radius), step = 0.002, omega = 2 * pi * step;
    const Spectrum s = spectrum(generalised_alpha(radius), step);
    EXPECT_NEAR(s.period_error / (omega * omega), 1.0 / 12 + 3 * y * y / 8, 1e-3);
    EXPECT_NEAR(s.damping / (omega * omega * omega), y * y * y / 2, 5e-3);
  }
}

TEST(Oscillator, StartsWithTheAccelerationOfItsForces) {
  Mode mode = forced();
  mode.load = [](double t) { return 3 + t; };
  ModalSystem system(false, mode);
  system.start(0.5, -2);
  EXPECT_NEAR(system.a(), 3 - mode.k * 0.5 + mode.c * 2, 1e-12);
}

TEST(Oscillator, TheCommittedStateAndTheFirstGuessAreEvaluatedOnceEach) {
  Mode mode;
  mode.k = 0;  // continues at its velocity, which is the first guess
  ModalSystem system(false, mode);
  system.start(0.5, -2);
  const int before = system.evaluations();
  const StepReport report = system.attempt(0.1, generalised_alpha(0.8), NewtonOptions());
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.newton_iterations, 0);
  EXPECT_EQ(system.evaluations() - before, 2);
}

}  // namespace
}  // namespace mudline
