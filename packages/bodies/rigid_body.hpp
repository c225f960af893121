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

/// Where a body is: its centre of mass [m] and the rotation about it, from the orientation of the body's own frame.
struct BodyPlacement {
  Point centre{};
  Rotation turn{};
  /// In space, of a body with unknowns: its increment of rotation in the step, along its axes [rad].
  Point increment{};

  /// The rotation about the model's axes that comes on top per unit of the increment's component [rad/rad].
  Point turning(int component) const;
};

/// The unknowns of a body that may move freely in some stage: components of one point of the field "body motion".
/// Directions are the axes of the model, then the rotations: about z in the plane.
/// Translations are those of the centre of mass [m]; a rotation is carried as an arc, the angle times the radius of
/// gyration, so that all components have the unit m, the mass as inertia, and one norm.
///
/// In space the changes of the rotations over a step are the body's increment of rotation along its own axes, see
/// Rotation::by_increment, and their rates its spin about those. Their values, the sums of the increments, mean nothing
/// by themselves: what is turned on from is in the body's state.
struct BodyUnknowns {
  int count = 0;  // 0: the body's motion is prescribed in every stage
  int direction[body_directions] = {0, 1, 2, 3, 4, 5};
  double scale[body_directions] = {1, 1, 1, 1, 1, 1};   // direction's value per unit of the unknown
  int dof[body_directions] = {-1, -1, -1, -1, -1, -1};  // local (overlap)
  bool owned = false;                                   // by this rank
  int field = -1;
};

/// A rigid body: a contour in the plane or a surface in space, its position, its mass, and the law of motion that holds
/// in the present stage. A body that is free in some stage has unknowns; its placement is then that of the nodal state.
/// Of the others displacement and velocity live in the state array "body/<name>/motion" (one row, the same on every
/// rank), and so do the time in motion of all, and in space the rotation at the start of the last step.
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
  /// In the plane.
  const Contour& contour() const { return *contour_; }
  /// In space, in the body's frame; null in the plane.
  const Surface* surface() const { return surface_.get(); }
  const BodyProperties& properties() const { return properties_; }
  /// Of the reference point before any motion [m].
  const Point& initial_position() const { return position_; }
  BodyPlacement initial_placement() const { return {position_ + start_turn_(centre_), start_turn_}; }
  /// As it is placed at the start, at rest, at time 0: for what asks its loads before the first step.
  BodyInstant initial_instant() const;
  /// Height [m] above the reference point, in the body's frame, below which contact counts as the tip's.
  double tip_height() const { return tip_height_; }
  /// Sampled points of its surface [m], in the coordinates of the mesh; of a half contour with its other half.
  std::vector<Point> outline(const BodyPlacement& placement) const;
  /// What it covers, seen along a direction of the mesh (of any length but 0): half its `width` is the half width of a
  /// body that moves or presses that way. In the plane `width` and `length` are equal.
  Shadow shadow(const BodyPlacement& placement, const Point& direction) const;
  /// Its extent [m] along the upright axis of its own frame.
  double own_height() const;
  /// The longest way [m] of a sampled point of its surface from one placement to another.
  double way(const BodyPlacement& from, const BodyPlacement& to) const;
  /// A body of revolution by the name of its shape.
  bool of_revolution() const { return of_revolution_; }

  /// Whether one of the motions read so far releases the body: it then needs unknowns.
  bool may_be_free() const { return may_be_free_; }
  static int unknowns_per_body(Geometry geometry);
  /// Gives the body point `index` of the field `field`.
  void bind(const Space& space, int field, int index);
  const BodyUnknowns& unknowns() const { return unknowns_; }
  /// May be called by everything that touches the body; the first call declares.
  void declare_state(StateStore& store);

  /// The motion of the present stage; null: the body rests where it is. Returns whether that is another one.
  bool set_motion(std::shared_ptr<const BodyMotion> motion);
  /// Its own motion or none.
  void set_active(bool active) { set_motion(active ? own_motion_ : nullptr); }
  const std::shared_ptr<const BodyMotion>& own_motion() const { return own_motion_; }
  bool active() const { return motion_ != nullptr; }
  /// The free motion of the present stage, null while the motion is prescribed or the body rests.
  const ReleasedMotion* released() const { return motion_ ? motion_->released() : nullptr; }
  /// Whether the direction is an unknown in the present stage.
  bool releases(int direction) const { return released() && released()->releases(direction); }
  /// Starts the clock of the motion (its ramp) in the committed state.
  void restart_clock(State& committed) const;

  /// Moves the body over the step: writes the trial state from the committed one; the unknowns of a body that has some
  /// are the integrator's. May be called any number of times.
  void advance(const StepView& view) const;
  /// Prescribed motion over a step of a body with unknowns: displacement and velocity at its end.
  BodyState prescribed(const State& committed, double t_old, double t_end) const;
  /// Prescribes over such a step what does not move freely, with the rates of the motion.
  void prescribe(const State& committed, double t_old, double t_end, Constraints& to) const;
  /// Largest mean speed [m/s] of the body over any eighth of the dt [s] that follow the state; 0 when inactive.
  double speed(const State& state, double dt) const;

  /// Of the reference point.
  Point displacement(const State& state) const;
  Point velocity(const State& state) const;
  /// Of the reference point [m].
  Point position(const State& state) const;
  BodyPlacement placement(const State& state) const;
  /// With the unknowns `ahead` (by overlap dof) of where they are.
  BodyPlacement placement(const State& state, const ConstNodalView& ahead) const;
  /// Rotation vector [rad] from the orientation at the start, and spin [rad/s].
  Point rotation(const State& state) const { return (state_of(state).turn * start_turn_.inverse()).vector(); }
  Point spin(const State& state) const { return state_of(state).spin; }
  BodyState state_of(const State& state) const;
  /// Nearest point of the contour; x and the foot in the coordinates of the mesh. In the plane.
  ContourFoot closest(const BodyPlacement& placement, const PlanePoint& x) const;
  /// The same of the surface. In space.
  SurfaceFoot foot(const BodyPlacement& placement, const Point& x) const;
  /// Signed distance [m] of a point, negative inside.
  double gap(const BodyPlacement& placement, const Point& x) const;
  /// Height [m] of a point in the body's frame above the reference point.
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
  /// In space: the rotation of the unknowns from that of the row, along the body's axes, plus `ahead`.
  Point increment(const State& state, const ConstNodalView* ahead) const;
  Rotation turn_of_row(const State& state) const;
  Point in_frame(const BodyPlacement& placement, const Point& x) const;
  /// Of the reference point from the centre of mass, as the body is turned.
  Point arm(const BodyPlacement& placement) const { return -placement.turn(centre_); }
  Point from_frame(const BodyPlacement& placement, const Point& x) const {
    return placement.centre + placement.turn(x - centre_);
  }
  std::string name_;
  Point position_{}, centre_{};   // reference point in the mesh; centre of mass in the body's frame
  std::vector<double> rotation_;  // [deg] as the deck gives it
  Rotation start_turn_{};         // from the body's frame to its orientation at the start
  std::vector<double> inertia_;
  std::vector<Point> outline_;  // in the body's frame
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
