#include "bodies/motion.hpp"

#include <algorithm>

#include "bodies/released_motion.hpp"

namespace mudline {

namespace {

/// f at a time, axis by axis.
Point at(const Function (&f)[3], double time) { return {f[0](time, {}), f[1](time, {}), f[2](time, {})}; }

}  // namespace

bool PrescribedMotion::turns() const {
  return std::any_of(std::begin(about_), std::end(about_), [](const Function& f) { return !f.is_zero(); });
}

void PrescribedDisplacement::parameters(Parameters& p) {
  p.add("x", along_[0], "m", "Horizontal displacement as a function of time; only its changes count");
  p.add("y", along_[1], "m",
        "Displacement as a function of time, in the plane vertical, upwards positive; only its changes count");
  if (p.dimension() == 3) turning_parameters(p);
  if (!p.documenting()) refuse_rest(p);
}

void PrescribedDisplacement::turning_parameters(Parameters& p) {
  p.add("z", along_[2], "m", "In space: vertical displacement, upwards positive; only its changes count");
  p.add("rotation x", about_[0], "rad",
        "In space: component of the rotation vector about the centre of mass; only its changes count");
  p.add("rotation y", about_[1], "rad", "The same about y");
  p.add("rotation z", about_[2], "rad", "The same about z");
}

void PrescribedDisplacement::refuse_rest(Parameters& p) const {
  const auto refuse = [&](const std::string& entry) {
    p.deck().fail("is constant, and only its changes count: give a function of time, such as -0.01*t", entry);
  };
  const auto rests = [](const Function& f) { return f.is_constant() && !f.is_zero(); };
  for (int i = 0; i < 3; ++i)
    if (rests(along_[i])) refuse(axis_names[i]);
  // beside one that changes a constant component of a rotation vector has a meaning
  if (!std::all_of(std::begin(about_), std::end(about_), [](const Function& f) { return f.is_constant(); })) return;
  for (int i = 0; i < 3; ++i)
    if (rests(about_[i])) refuse(std::string("rotation ") + axis_names[i]);
}

BodyState PrescribedDisplacement::advance(const BodyState& old, double t_old, double t_end) const {
  BodyState now = old;
  const double dt = t_end - t_old, per_time = dt > 0 ? 1 / dt : 0.0;
  const Point increment = at(along_, t_end) - at(along_, t_old);
  now.displacement = old.displacement + increment;
  for (int i = 0; i < 3; ++i) now.velocity[i] = dt > 0 ? increment[i] / dt : 0.0;
  if (turns()) {
    const Rotation more = Rotation::by(at(about_, t_end)) * Rotation::by(at(about_, t_old)).inverse();
    now.turn = more * old.turn;
    now.spin = per_time * more.vector();
  }
  now.moving_time += dt;
  return now;
}

void PrescribedVelocity::parameters(Parameters& p) {
  p.add("velocity x", along_[0], "m/s", "Horizontal velocity as a function of time");
  p.add("velocity y", along_[1], "m/s",
        "Velocity as a function of time, in the plane vertical, upwards positive: a push down is negative");
  if (p.dimension() == 3) {
    p.add("velocity z", along_[2], "m/s", "In space: vertical velocity, upwards positive: a push down is negative");
    p.add("spin x", about_[0], "rad/s", "In space: spin about the x axis through the centre of mass, right-handed");
    p.add("spin y", about_[1], "rad/s", "The same about y");
    p.add("spin z", about_[2], "rad/s", "The same about z");
  }
  p.add("ramp time", ramp_time_, "s", non_negative(),
        "Smooth acceleration from rest over this time after the body starts to move");
}

double PrescribedVelocity::ramp(double moving_time) const {
  const double s = ramp_time_ > 0 ? std::min(1.0, moving_time / ramp_time_) : 1.0;
  return s * s * (3 - 2 * s);
}

BodyState PrescribedVelocity::advance(const BodyState& old, double t_old, double t_end) const {
  constexpr int points = 4;
  constexpr double place[points] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  constexpr double weight[points] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  BodyState now = old;
  const double dt = t_end - t_old, to_ramp_end = ramp_time_ - old.moving_time;
  Point turned{};
  const auto integrate = [&](double from, double to) {
    for (int i = 0; i < points; ++i) {
      const double tau = 0.5 * (from + to) + 0.5 * (to - from) * place[i], share = 0.5 * (to - from) * weight[i];
      const double factor = ramp(old.moving_time + tau);
      const Point v = at(along_, t_old + tau), spin = at(about_, t_old + tau);
      for (int c = 0; c < 3; ++c) now.displacement[c] += share * (factor * v[c]);
      for (int c = 0; c < 3; ++c) turned[c] += share * (factor * spin[c]);
    }
  };
  const double split = to_ramp_end > 0 && to_ramp_end < dt ? to_ramp_end : 0.0;
  if (split > 0) integrate(0, split);
  integrate(split, dt);
  now.moving_time += dt;
  now.velocity = ramp(now.moving_time) * at(along_, t_end);
  if (turns()) {
    now.turn = Rotation::by(turned) * old.turn;
    now.spin = ramp(now.moving_time) * at(about_, t_end);
  }
  return now;
}

BodyState Held::advance(const BodyState& old, double t_old, double t_end) const {
  return {old.displacement, {}, old.turn, {}, old.moving_time + t_end - t_old};
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
