#include "bodies/motion.hpp"

#include <algorithm>

#include "bodies/released_motion.hpp"

namespace mudline {

void PrescribedDisplacement::parameters(Parameters& p) {
  p.add("x", x_, "m", "Horizontal displacement as a function of time; only its changes count");
  p.add("y", y_, "m", "Vertical displacement as a function of time, upwards positive; only its changes count");
}

BodyState PrescribedDisplacement::advance(const BodyState& old, double t_old, double t_end) const {
  BodyState now = old;
  const double dt = t_end - t_old;
  const Function* functions[2] = {&x_, &y_};
  for (int i = 0; i < 2; ++i) {
    const double increment = (*functions[i])(t_end, {}) - (*functions[i])(t_old, {});
    now.displacement[i] += increment;
    now.velocity[i] = dt > 0 ? increment / dt : 0.0;
  }
  now.moving_time += dt;
  return now;
}

void PrescribedVelocity::parameters(Parameters& p) {
  p.add("velocity x", x_, "m/s", "Horizontal velocity as a function of time");
  p.add("velocity y", y_, "m/s", "Vertical velocity as a function of time, upwards positive: a push down is negative");
  p.add("ramp time", ramp_time_, "s", non_negative(),
        "Smooth acceleration from rest over this time after the body starts to move");
}

std::array<double, 2> PrescribedVelocity::velocity(double time, double moving_time) const {
  const double s = ramp_time_ > 0 ? std::min(1.0, moving_time / ramp_time_) : 1.0;
  const double ramp = s * s * (3 - 2 * s);
  return {ramp * x_(time, {}), ramp * y_(time, {})};
}

BodyState PrescribedVelocity::advance(const BodyState& old, double t_old, double t_end) const {
  constexpr int points = 4;
  constexpr double at[points] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  constexpr double weight[points] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  BodyState now = old;
  const double dt = t_end - t_old, to_ramp_end = ramp_time_ - old.moving_time;
  const auto integrate = [&](double from, double to) {
    for (int i = 0; i < points; ++i) {
      const double tau = 0.5 * (from + to) + 0.5 * (to - from) * at[i];
      const auto v = velocity(t_old + tau, old.moving_time + tau);
      for (int c = 0; c < 2; ++c) now.displacement[c] += 0.5 * (to - from) * weight[i] * v[c];
    }
  };
  const double split = to_ramp_end > 0 && to_ramp_end < dt ? to_ramp_end : 0.0;
  if (split > 0) integrate(0, split);
  integrate(split, dt);
  now.moving_time += dt;
  now.velocity = velocity(t_end, now.moving_time);
  return now;
}

BodyState Held::advance(const BodyState& old, double t_old, double t_end) const {
  return {old.displacement, {0, 0}, old.moving_time + t_end - t_old};
}

void register_motions(Registry<BodyMotion>& registry) {
  registry.add<PrescribedDisplacement>("prescribed displacement", "Displacement given as functions of time");
  registry.add<PrescribedVelocity>("prescribed velocity", "Velocity given as functions of time, with a smooth start");
  registry.add<ForceMotion>("force", "Moves under given forces, with or without mass, against what touches it");
  registry.add<FreeMotion>("free",
                           "Falls or floats: weight, buoyancy, drag and added mass of the water, initial velocity");
  registry.add<Held>("held", "Stays where it is");
}

}  // namespace mudline
