#include <algorithm>
#include <cmath>

#include "integrator/time_scheme.hpp"

namespace mudline {

namespace {

enum class PressureIntegration { generalised_alpha, theta };

/// Time integration of the pore pressure together with the displacements.
struct PressureOptions {
  PressureIntegration kind = PressureIntegration::generalised_alpha;
  double theta = 1.0;
  void parameters(Parameters& p) {
    p.choice(
        "pore pressure integration", kind,
        {{"generalised alpha", PressureIntegration::generalised_alpha}, {"theta", PressureIntegration::theta}},
        "first-order generalised-alpha at the same instant, or the mass balance integrated over the step with theta");
    p.add("theta", theta, "-", closed(0.5, 1.0), "weight of the new pore pressure when it is integrated with theta");
  }
  void apply(TimeScheme& s) const {
    if (kind != PressureIntegration::theta) return;
    s.incremental = true;
    s.theta = theta;
  }
};

/// First-order generalised-alpha evaluated at the same instant as displacements with this alpha_f.
void match_pressure(TimeScheme& s, double radius) {
  s.flow_alpha_m = (3 - radius) / (2 * (1 + radius));
  s.flow_alpha_f = 1 / (1 + radius);
  s.theta = 0.5 + s.flow_alpha_m - s.flow_alpha_f;
}

class GeneralisedAlpha : public TimeIntegrator {
 public:
  void parameters(Parameters& p) {
    p.add("spectral radius", radius_, "-", closed(0, 1),
          "at infinite frequency: 1 no damping, 0 annihilation in one step");
    pressure_.parameters(p);
  }
  TimeScheme scheme(int) const override {
    TimeScheme s = generalised_alpha(radius_);
    pressure_.apply(s);
    return s;
  }
  bool dynamic() const override { return true; }

 private:
  double radius_ = 0.8;
  PressureOptions pressure_;
};

class Newmark : public TimeIntegrator {
 public:
  void parameters(Parameters& p) {
    p.add("gamma", gamma_, "-", closed(0.5, 1.0), "velocity weight; 0.5 no damping");
    p.add("beta", beta_, "-", open(0.0, 1.0), "displacement weight; (gamma + 1/2)^2/4 is the smallest stable value");
    pressure_.parameters(p);
  }
  void check(const Section& section) const {
    const double least = 0.25 * (gamma_ + 0.5) * (gamma_ + 0.5);
    if (beta_ < least - 1e-9)
      section.fail("unconditional stability needs beta >= (gamma + 1/2)^2/4 = " + std::to_string(least), "beta");
  }
  TimeScheme scheme(int) const override {
    TimeScheme s;
    s.beta = beta_;
    s.gamma = gamma_;
    s.theta = gamma_;  // the same for the pore pressure: balance at n+1, trapezoidal rule with gamma
    pressure_.apply(s);
    return s;
  }
  bool dynamic() const override { return true; }

 private:
  double gamma_ = 0.5, beta_ = 0.25;
  PressureOptions pressure_;
};

class HilberHughesTaylor : public TimeIntegrator {
 public:
  void parameters(Parameters& p) {
    p.add("alpha", alpha_, "-", closed(0, 1.0 / 3), "weight of the old level in the forces; 0: trapezoidal rule");
    pressure_.parameters(p);
  }
  TimeScheme scheme(int) const override {
    TimeScheme s;
    s.alpha_f = alpha_;
    s.gamma = 0.5 + alpha_;
    s.beta = 0.25 * (1 + alpha_) * (1 + alpha_);
    match_pressure(s, alpha_ / (1 - alpha_));
    pressure_.apply(s);
    return s;
  }
  bool dynamic() const override { return true; }

 private:
  double alpha_ = 0.1;
  PressureOptions pressure_;
};

class Theta : public TimeIntegrator {
 public:
  void parameters(Parameters& p) {
    p.add("theta", theta_, "-", closed(0.5, 1.0), "1: backward Euler; 0.5: second order");
    p.add("start-up steps", startup_, "-", closed(0, 100),
          "backward Euler steps at the begin of the stage, which damp the ringing that theta below 1 would keep after "
          "a sudden load");
  }
  TimeScheme scheme(int step) const override {
    TimeScheme s;
    s.inertia = false;
    s.incremental = true;
    s.theta = step < startup_ ? 1.0 : theta_;
    return s;
  }
  bool dynamic() const override { return false; }

 private:
  double theta_ = 1.0;
  int startup_ = 4;
};

}  // namespace

TimeScheme generalised_alpha(double r) {
  TimeScheme s;
  s.alpha_m = (2 * r - 1) / (r + 1);
  s.alpha_f = r / (r + 1);
  s.gamma = 0.5 - s.alpha_m + s.alpha_f;
  s.beta = 0.25 * (1 - s.alpha_m + s.alpha_f) * (1 - s.alpha_m + s.alpha_f);
  match_pressure(s, r);
  return s;
}

void register_time_integrators(Registry<TimeIntegrator>& registry) {
  registry.add<GeneralisedAlpha>("generalised alpha",
                                 "Chung-Hulbert for displacements, first-order generalised-alpha for pore pressure");
  registry.add<Newmark>("newmark", "Newmark's method; the pore pressure is treated the same way");
  registry.add<HilberHughesTaylor>("hht alpha", "Hilber-Hughes-Taylor alpha method");
  registry.add<Theta>("theta", "one-step theta method without inertia, for quasi-static stages");
}

}  // namespace mudline
