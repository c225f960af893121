#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bodies/released_motion.hpp"
#include "discretisation/mesh.hpp"
#include "framework/constraints.hpp"
#include "framework/state.hpp"
#include "framework/term.hpp"
#include "geometry/shadow.hpp"
#include "geometry/surface_shape.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// The registries an entry of the deck's "bodies" needs.
struct BodyRegistries {
  const Registry<ContourShape>& contours;
  const SurfaceRegistry& surfaces;
  const Registry<BodyMotion>& motions;
};

/// Placement of a body: its centre of mass [m] and the rotation about it, from the orientation of the body frame.
struct BodyPlacement {
  Point centre{};
  Rotation turn{};
  /// Increment of rotation in the step, along the body's axes [rad]; of a body in space with unknowns, else 0.
  Point increment{};

  /// Derivative of the rotation, as a vector in the world frame, by a component of the increment [rad/rad].
  Point turning(int component) const;
};

/// The unknowns of a body that may move freely in some stage: components of one point of the field "body motion".
/// Directions are the world axes, then the rotations: about z in the plane. Translations are those of the centre of
/// mass [m]; a rotation is stored as an arc, the angle times the radius of gyration, so that all components have the
/// unit m, the mass as inertia, and one norm.
///
/// In space the changes of the rotations over a step are the body's increment of rotation along its own axes, see
/// Rotation::by_increment, and their rates are its spin about these axes. Their values, the sums of the increments,
/// mean nothing by themselves: the rotation at the start of the step is in the body's state.
struct BodyUnknowns {
  int count = 0;  // 0: the body's motion is prescribed in every stage
  int direction[body_directions] = {0, 1, 2, 3, 4, 5};
  double scale[body_directions] = {1, 1, 1, 1, 1, 1};   // direction's value per unit of the unknown
  int dof[body_directions] = {-1, -1, -1, -1, -1, -1};  // local (overlap)
  bool owned = false;                                   // by this rank
  int field = -1;
};

/// A rigid body: a contour in the plane or a surface in space, its position, its mass, and the law of motion that holds
/// in the present stage. A body that is free in some stage has unknowns; its placement then follows from the nodal
/// state. Displacement and velocity of other bodies are in the state array "body/<name>/motion" (one row, the same on
/// every rank), as are the time in motion of all bodies, and in space the rotation at the start of the last step.
class RigidBody {
 public:
  /// Reads and validates an entry of "bodies". InputError.
  static std::shared_ptr<RigidBody> read(const Section& section, Geometry geometry, const BodyRegistries& registries);
  /// Documentation of the entry's own parameters.
  static void document(Parameters& p) { RigidBody().parameters(p); }
  /// Another motion of this body, for a stage. InputError where it does not fit the body.
  std::shared_ptr<const BodyMotion> read_motion(const Section& section, const Registry<BodyMotion>& motions);

  const std::string& name() const { return name_; }
  int dimension() const { return mudline::dimension(properties_.geometry); }
  /// The contour in the plane, in the body frame.
  const Contour& contour() const { return *contour_; }
  /// The surface in space, in the body frame; null in the plane.
  const Surface* surface() const { return surface_.get(); }
  const BodyProperties& properties() const { return properties_; }
  /// Position of the reference point before any motion [m].
  const Point& initial_position() const { return position_; }
  BodyPlacement initial_placement() const { return {position_ + start_turn_(centre_), start_turn_}; }
  /// The body at its initial placement, at rest, at time 0: for loads before the first step.
  BodyInstant initial_instant() const;
  /// Height [m] above the reference point, in the body frame, below which contact forces count as the tip's.
  double tip_height() const { return tip_height_; }
  /// Sampled points of its surface [m], in the world frame; a half contour is completed by its other half.
  std::vector<Point> outline(const BodyPlacement& placement) const;
  /// Shadow of the body along a direction in the world frame (of any length but 0). Half its `width` is the half width
  /// of a body that moves or presses in that direction. In the plane `width` and `length` are equal.
  Shadow shadow(const BodyPlacement& placement, const Point& direction) const;
  /// Its extent [m] along the upright axis of the body frame.
  double own_height() const;
  /// The largest displacement [m] of a sampled point of its surface from one placement to another.
  double largest_displacement(const BodyPlacement& from, const BodyPlacement& to) const;
  /// Whether its shape is a body of revolution.
  bool of_revolution() const { return of_revolution_; }

  /// Whether one of the motions read so far releases the body: it then needs unknowns.
  bool may_be_free() const { return may_be_free_; }
  static int unknowns_per_body(Geometry geometry);
  /// Gives the body point `index` of the field `field`.
  void bind(const Space& space, int field, int index);
  const BodyUnknowns& unknowns() const { return unknowns_; }
  /// May be called by everything that touches the body; the first call declares.
  void declare_state(StateStore& store);

  /// Sets the motion of the present stage; null: the body rests. Returns whether the motion changed.
  bool set_motion(std::shared_ptr<const BodyMotion> motion);
  /// Sets the body's own motion, or none.
  void set_active(bool active) { set_motion(active ? own_motion_ : nullptr); }
  const std::shared_ptr<const BodyMotion>& own_motion() const { return own_motion_; }
  bool active() const { return motion_ != nullptr; }
  /// The free motion of the present stage, null while the motion is prescribed or the body rests.
  const ReleasedMotion* released() const { return motion_ ? motion_->released() : nullptr; }
  /// Whether the direction is an unknown in the present stage.
  bool releases(int direction) const { return released() && released()->releases(direction); }
  /// Starts the clock of the motion (its ramp) in the committed state.
  void restart_clock(State& committed) const;

  /// Moves the body over the step: writes the trial state from the committed one; a body's unknowns are left to the
  /// integrator. May be called any number of times.
  void advance(const StepView& view) const;
  /// Prescribed motion over a step of a body with unknowns: displacement and velocity at its end.
  BodyState prescribed(const State& committed, double t_old, double t_end) const;
  /// Prescribes the unknowns that are not released over such a step, with the rates of the motion.
  void prescribe(const State& committed, double t_old, double t_end, Constraints& to) const;
  /// Largest mean speed [m/s] of the body over any eighth of the dt [s] that follow the state; 0 when inactive.
  double speed(const State& state, double dt) const;

  /// Displacement [m] and velocity [m/s] of the reference point.
  Point displacement(const State& state) const;
  Point velocity(const State& state) const;
  /// Acceleration [m/s2] of the centre of mass along its unknowns; zero along others.
  Point acceleration(const State& state) const;
  /// Position of the reference point [m].
  Point position(const State& state) const;
  BodyPlacement placement(const State& state) const;
  /// The placement after the unknowns have changed by `ahead` (by overlap dof).
  BodyPlacement placement(const State& state, const ConstNodalView& ahead) const;
  /// Rotation vector from the orientation at the start [rad], and spin [rad/s].
  Point rotation(const State& state) const { return (state_of(state).turn * start_turn_.inverse()).vector(); }
  Point spin(const State& state) const { return state_of(state).spin; }
  BodyState state_of(const State& state) const;
  /// Closest point on the contour, in the plane; x and the closest point are in the world frame.
  ContourProjection closest(const BodyPlacement& placement, const PlanePoint& x) const;
  /// Closest point on the surface, in space, in the world frame.
  SurfaceProjection projection(const BodyPlacement& placement, const Point& x) const;
  /// Signed distance [m] of a point, negative inside.
  double gap(const BodyPlacement& placement, const Point& x) const;
  /// Height [m] of a point above the reference point, in the body frame.
  double height(const BodyPlacement& placement, const Point& x) const;
  /// Radius [m] around the centre of mass within which the body is drawn.
  double reach() const { return reach_; }

 private:
  RigidBody() = default;
  void parameters(Parameters& p);
  void read_contour(const Section& section, const BodyRegistries& registries);
  void read_surface(const Section& section, const BodyRegistries& registries);
  void read_rotation(const Section& section);
  void fill_evenly(const Section& section);
  /// In space: increment of rotation by the unknowns since the state's row was written, along the body's axes, plus
  /// `ahead` [rad].
  Point increment(const State& state, const ConstNodalView* ahead) const;
  /// In space: the rotation at the start of the last step, from the state's row.
  Rotation turn_of_row(const State& state) const;
  /// In space: writes the rotation at the start of a step, and the spin of a prescribed motion at its end.
  void turn_row(const StepView& view, const BodyState& now) const;
  Point in_frame(const BodyPlacement& placement, const Point& x) const;
  /// From the centre of mass to the reference point, in the world frame [m].
  Point arm(const BodyPlacement& placement) const { return -placement.turn(centre_); }
  Point from_frame(const BodyPlacement& placement, const Point& x) const {
    return placement.centre + placement.turn(x - centre_);
  }
  std::string name_;
  Point position_{}, centre_{};   // reference point in the world frame; centre of mass in the body frame
  std::vector<double> rotation_;  // [deg] as the deck gives it
  Rotation start_turn_{};         // from the body frame to its orientation at the start
  std::vector<double> inertia_;
  std::vector<Point> outline_;  // in the body frame
  bool has_centre_ = false;
  BodyProperties properties_;
  double tip_height_ = 0, reach_ = 0;
  std::unique_ptr<const Contour> contour_;
  std::shared_ptr<const Surface> surface_;
  std::unique_ptr<const ContourVolume> enclosed_;
  std::shared_ptr<const BodyMotion> own_motion_, motion_;
  BodyUnknowns unknowns_;
  bool may_be_free_ = false, of_revolution_ = false;
  int array_ = -1;
};

}  // namespace mudline
