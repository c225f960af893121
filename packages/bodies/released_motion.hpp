#pragma once

#include <string>
#include <vector>

#include "bodies/body_water.hpp"
#include "bodies/motion.hpp"

namespace mudline {

/// Motion by Newton's law: the body's released directions are unknowns of the nonlinear system, the others rest or move
/// as prescribed.
class ReleasedMotion : public BodyMotion {
 public:
  BodyState advance(const BodyState& old, double t_old, double t_end) const override;
  bool moves(int axis) const override { return axis < dimension_ && (releases(axis) || others_.moves(axis)); }
  bool turns() const override { return rotates() || others_.turns(); }
  const ReleasedMotion* released() const override { return this; }
  bool releases(int direction) const { return released_[direction]; }
  /// Whether it releases any rotation.
  bool rotates() const;

  /// Loads on the body other than those from contact. Pure.
  virtual BodyLoad load(const BodyProperties& body, const BodyInstant& at) const;
  /// Water that is accelerated with the body.
  virtual AddedMass added_mass(const BodyProperties&) const { return {}; }
  /// Sets the velocity [m/s] and spin [rad/s] with which the body is released; false: it keeps those that it has.
  virtual bool initial_velocity(Point& velocity, Point& spin) const { return false; }
  /// InputError where this motion does not fit the body.
  virtual void check_body(const BodyProperties& body, const Section& section) const;

 protected:
  /// Declares the parameters that all released motions share.
  void common_parameters(Parameters& p);
  /// Throws InputError: the deck's entry is for a direction in which the body does not move.
  void refuse(const Section& section, int direction, const std::string& entry) const;
  int dimension_ = 2;
  Point gravity_{};

 private:
  void read_freedom(Parameters& p);
  void read_loads(Parameters& p);
  void check_others(const Section& section) const;
  std::vector<std::string> freedom_{"y"};
  bool released_[body_directions] = {};
  Function force_[3], moment_[3];
  std::vector<PointLoad> loads_;
  PrescribedVelocity others_;
};

/// Given forces, functions of time and of the position of the reference point, and the weight where gravity is given.
class ForceMotion : public ReleasedMotion {
 public:
  void parameters(Parameters& p) { common_parameters(p); }
};

/// Weight, water and given forces; the body may start with a velocity.
class FreeMotion : public ReleasedMotion {
 public:
  void parameters(Parameters& p);
  BodyLoad load(const BodyProperties& body, const BodyInstant& at) const override;
  AddedMass added_mass(const BodyProperties& body) const override { return water_.moved(body); }
  bool initial_velocity(Point& velocity, Point& spin) const override;
  void check_body(const BodyProperties& body, const Section& section) const override;

 private:
  BodyWater water_;
  Point initial_velocity_{}, initial_spin_{};
  bool starts_ = false;
};

}  // namespace mudline
