#pragma once

#include <string>
#include <vector>

#include "bodies/contour_volume.hpp"
#include "bodies/motion.hpp"

namespace mudline {

/// Directions of a body's freedom: x, y, rotation (counter-clockwise).
constexpr int body_directions = 3;
/// Whether a body may move so at all: a body of revolution only along its axis.
inline bool may_move(Geometry geometry, int direction) { return geometry != Geometry::axisymmetric || direction == 1; }

/// What the loads on a body depend on, besides its motion. Axisymmetric: of the whole body; plane strain: per metre of
/// depth, and of the modelled half where the contour is a half one.
struct BodyProperties {
  double mass = 0;               // [kg]
  double moment_of_inertia = 0;  // [kg m2] about the centre of mass
  double volume = 0;             // [m3]; 0: unknown
  Geometry geometry = Geometry::plane_strain;
  const ContourVolume* enclosed = nullptr;
};

/// Where a body is and how it moves when its loads are asked: reference point [m] and angle [rad], and their rates.
struct BodyInstant {
  double time;
  std::array<double, body_directions> position, velocity;
};

/// Force [N] and moment about the centre of mass [N m] on a body, and their derivatives.
struct BodyLoad {
  std::array<double, body_directions> force{};
  double by_position[body_directions][body_directions] = {};
  double by_velocity[body_directions][body_directions] = {};
};

/// A body that moves as Newton's law says: its released directions are unknowns of the nonlinear system, the others
/// rest.
class ReleasedMotion : public BodyMotion {
 public:
  BodyState advance(const BodyState& old, double t_old, double t_end) const override;
  bool moves(int axis) const override { return axis < 2 && releases(axis); }
  bool turns() const override { return releases(2); }
  const ReleasedMotion* released() const override { return this; }
  bool releases(int direction) const { return released_[direction]; }

  /// Loads other than those of what touches the body. Pure.
  virtual BodyLoad load(const BodyProperties& body, const BodyInstant& at) const;
  /// [kg] that is accelerated with the body.
  virtual double added_mass(const BodyProperties&) const { return 0; }
  /// The velocity [m/s] with which the body is set free; false: it keeps the one it has.
  virtual bool initial_velocity(std::array<double, 2>&) const { return false; }
  /// InputError where a body like this cannot move so.
  virtual void check_body(const BodyProperties& body, const Section& section) const;

 protected:
  /// Declares what all released motions share.
  void common_parameters(Parameters& p);
  std::array<double, 2> gravity_{};

 private:
  std::vector<std::string> freedom_{"y"};
  bool released_[body_directions] = {false, false, false};
  Function force_[body_directions];
};

/// Given forces, functions of time and of the position of the reference point, and the weight where gravity is given.
class ForceMotion : public ReleasedMotion {
 public:
  void parameters(Parameters& p) { common_parameters(p); }
};

/// The water around a body. Buoyancy is the weight of the water displaced above the mudline; below it the soil's own
/// pressure acts, which contact knows. Drag 1/2 rho C_d A |v| v, times the share of the volume that is in the water.
struct BodyWater {
  void parameters(Parameters& p);
  double density = 0, drag = 0, area = 0, added_mass = 0, mudline = 0;
  bool has_mudline = false;
};

/// Weight, water and given forces; the body may start with a velocity.
class FreeMotion : public ReleasedMotion {
 public:
  FreeMotion() { gravity_ = {0, -9.81}; }
  void parameters(Parameters& p);
  BodyLoad load(const BodyProperties& body, const BodyInstant& at) const override;
  double added_mass(const BodyProperties& body) const override {
    return water_.added_mass * water_.density * body.volume;
  }
  bool initial_velocity(std::array<double, 2>& velocity) const override;
  void check_body(const BodyProperties& body, const Section& section) const override;

 private:
  BodyWater water_;
  std::array<double, 2> initial_velocity_{};
  bool starts_ = false;
};

}  // namespace mudline
