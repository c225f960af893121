#pragma once

#include <memory>
#include <string>
#include <vector>

#include "discretisation/mesh.hpp"
#include "physics/rigid_body/contour_shape.hpp"
#include "physics/rigid_body/motion.hpp"
#include "physics/state.hpp"
#include "physics/term.hpp"

namespace mudline {

/// The registries an entry of the deck's "bodies" needs.
struct BodyRegistries {
  const Registry<ContourShape>& contours;
  const Registry<BodyMotion>& motions;
};

/// A rigid body that translates: a contour, its position, and its law of motion. Displacement, velocity and time in
/// motion live in the state array "body/<name>/motion" (one row, the same on every rank).
class RigidBody {
 public:
  /// Reads and validates an entry of "bodies". InputError.
  static std::shared_ptr<RigidBody> read(const Section& section, Geometry geometry, const BodyRegistries& registries);
  /// Documentation of the entry's own parameters.
  static void document(Parameters& p) { RigidBody().parameters(p); }

  const std::string& name() const { return name_; }
  const Contour& contour() const { return *contour_; }
  /// Of the reference point before any motion [m].
  const std::array<double, 2>& initial_position() const { return position_; }

  /// May be called by everything that touches the body; the first call declares.
  void declare_state(StateStore& store);
  /// An inactive body rests where it is; when it becomes active again its ramp starts anew.
  void set_active(bool active) { active_ = active; }
  bool active() const { return active_; }

  /// Moves the body over the step: writes the trial state from the committed one. May be called any number of times.
  void advance(const StepView& view) const;
  /// Largest mean speed [m/s] of the body over any eighth of the dt [s] that follow the state; 0 when inactive.
  double speed(const State& state, double dt) const;

  std::array<double, 2> displacement(const State& state) const;
  std::array<double, 2> velocity(const State& state) const;
  /// Of the reference point [m].
  std::array<double, 2> position(const State& state) const;
  /// Nearest point of the contour; x and the foot in the coordinates of the mesh.
  ContourFoot closest(const State& state, const PlanePoint& x) const { return closest(position(state), x); }
  /// The same for a reference point at `position`.
  ContourFoot closest(const std::array<double, 2>& position, const PlanePoint& x) const;
  /// Polyline of the contour where it is now, for output.
  std::vector<PlanePoint> sample(const State& state, double chord_error) const;

 private:
  RigidBody() = default;
  void parameters(Parameters& p);
  BodyState body_state(const State& state) const;
  std::string name_;
  std::array<double, 2> position_{};
  std::unique_ptr<const Contour> contour_;
  std::unique_ptr<const BodyMotion> motion_;
  bool active_ = true;
  int array_ = -1;
};

/// Contours and motions of this package; a plain list.
void register_rigid_body(Registry<ContourShape>& contours, Registry<BodyMotion>& motions);

}  // namespace mudline
