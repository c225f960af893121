#include "bodies/rigid_body.hpp"

#include "core/guarded.hpp"
#include "core/pi.hpp"
#include "tensor/vec.hpp"

#include <algorithm>
#include <cmath>

namespace mudline {

void RigidBody::parameters(Parameters& p) {
  p.add("position", position_, "m",
        "Where the body's reference point (the tip of its contour) is before any motion; absent with an initial state "
        "'from result': where the result's body of this name stands");
  p.add(
      "mass", properties_.mass, "kg", non_negative(),
      "Axisymmetric: of the whole body; plane strain: per metre of depth, of the modelled half if the contour is half");
  const bool space = p.dimension() == 3;
  if (!space || p.documenting())
    p.add("moment of inertia", properties_.moment_of_inertia, "kg m2", non_negative(),
          "In the plane: about the centre of mass, per metre of depth; needed by a body that may rotate");
  if (space)
    p.add("inertia tensor", inertia_, "kg m2", any(),
          "In space: xx, yy, zz, or xx, yy, zz, yz, xz, xy (those with the sign of the tensor, -int y z dm) about the "
          "centre of mass, along the body's axes; absent: that of the surface filled evenly with the mass");
  p.add("centre of mass", centre_, "m",
        "In the body's frame, from the reference point; absent: there, and of a body in space with mass in the middle "
        "of its volume");
  has_centre_ = p.given("centre of mass");
  p.add("volume", properties_.volume, "m3", non_negative(),
        "Volume that displaces water; 0: that of the contour, if it is closed");
  p.add(
      "rotation", rotation_, "deg", any(),
      "How the body is turned about its reference point before any motion, with its centre of mass and its inertia: in "
      "space the rotation vector x, y, z (about its direction, right-handed, by its length), in the plane one number, "
      "counter-clockwise");
  p.add("tip height", tip_height_, "m", non_negative(),
        "Height above the reference point below which contact forces are the tip's, above it the shaft's; 0: the "
        "shape's own");
  p.passes_on("contour", "Shape of the body in the plane; 'type' names a contour");
  p.passes_on("surface", "Shape of the body in space; 'type' names a surface");
  p.passes_on("motion", "How the body moves, unless a stage says otherwise; 'type' names a motion");
}

std::shared_ptr<RigidBody> RigidBody::read(const Section& section, Geometry geometry,
                                           const BodyRegistries& registries) {
  std::shared_ptr<RigidBody> body(new RigidBody);
  body->name_ = section.name();
  Parameters p(section);
  body->parameters(p);
  p.finish();
  body->properties_.geometry = geometry;
  const bool space = geometry == Geometry::space;
  for (const char* other : {"contour", "surface"})
    if (section.has_section(other) && space != (std::string(other) == "surface"))
      section.fail(space ? "a body in space has a 'surface'; a contour is turned into one by the type 'revolved'"
                         : "a body in the plane has a 'contour'",
                   other);
  if (space)
    body->read_surface(section, registries);
  else
    body->read_contour(section, registries);
  body->own_motion_ = body->motion_ = body->read_motion(section.section("motion"), registries.motions);
  return body;
}

void RigidBody::read_contour(const Section& section, const BodyRegistries& registries) {
  const Section entry = section.section("contour");
  const auto shape = registries.contours.create(entry);
  contour_ = std::make_unique<Contour>(shape->contour(entry));
  of_revolution_ = shape->named() == ContourShape::Named::of_revolution;
  enclosed_ = std::make_unique<ContourVolume>(contour(), properties_.geometry);
  if (tip_height_ == 0) tip_height_ = shape->tip_height();
  const bool half = contour().extent() == ContourExtent::half;
  if (properties_.geometry == Geometry::axisymmetric && !half)
    entry.fail("an axisymmetric body has a half contour, not a full one", "extent");
  if (properties_.geometry == Geometry::axisymmetric && position_[0] != 0)
    section.fail("the axis of an axisymmetric body is r = 0: the first value must be 0", "position");
  if (half && centre_[0] != 0)
    section.fail("the centre of mass of a body with a half contour is on its axis: the first value must be 0",
                 "centre of mass");
  read_rotation(section);
  for (const PlanePoint& x : contour().sample(1e-3 * contour().length())) {
    outline_.push_back({x[0], x[1], 0});
    if (half) outline_.push_back({-x[0], x[1], 0});
  }
  properties_.enclosed = enclosed_.get();
  properties_.frontal_area =
      properties_.turned ? shadow(initial_placement(), {0, 1, 0}).width : enclosed_->frontal_area();
  properties_.centre = centre_;
  if (properties_.volume == 0) properties_.volume = enclosed_->total();
  reach_ = 0.5 * contour().length();
}

void RigidBody::read_surface(const Section& section, const BodyRegistries& registries) {
  const Section entry = section.section("surface");
  const auto shape = registries.surfaces.create(entry, {registries.surfaces, registries.contours});
  surface_ = shape->surface();
  if (tip_height_ == 0) tip_height_ = shape->tip_height();
  read_rotation(section);
  fill_evenly(section);
  constexpr double coarse = 0.01;  // share of the surface's extent; [m] where that is infinite
  const double extent = surface_->bounds().extent();
  outline_ = surface_->triangles(coarse * (std::isfinite(extent) ? extent : 1.0)).points;
  for (const Point& x : outline_) reach_ = std::max(reach_, length(x - centre_));
}

void RigidBody::read_rotation(const Section& section) {
  if (rotation_.empty()) return;
  const bool space = properties_.geometry == Geometry::space;
  const std::size_t needed = space ? 3 : 1;
  if (rotation_.size() != needed)
    section.fail((space ? "expected 3 numbers, a rotation vector in degrees, given "
                        : "expected 1 number, the angle in degrees, given ") +
                     std::to_string(rotation_.size()),
                 "rotation");
  const Point vector = pi / 180 * (space ? Point{rotation_[0], rotation_[1], rotation_[2]} : Point{0, 0, rotation_[0]});
  properties_.turned = length(vector) > 0;
  if (properties_.turned && contour_ && contour().extent() == ContourExtent::half)
    section.fail(
        "a body with a half contour stands upright on its axis: it takes no rotation; in plane strain a contour "
        "of 'extent' = full does",
        "rotation");
  start_turn_ = Rotation::by(vector);
}

void RigidBody::fill_evenly(const Section& section) {
  const SolidMoments moments = surface_->moments();
  const bool closed = moments.volume > 0;
  const double size = closed ? std::cbrt(moments.volume) : 1.0;
  if (closed && !has_centre_ && properties_.mass > 0) centre_ = moments.centroid();
  properties_.centre = centre_;
  if (closed) properties_.middle = moments.centroid() - centre_;
  if (properties_.volume == 0) properties_.volume = moments.volume;
  if (closed) {
    const SurfaceTriangles triangles = surface_->triangles(1e-3 * size);
    for (std::size_t t = 0; t < triangles.facets.size(); ++t)
      // A quarter: a convex body casts each shadow twice, and area vectors are double areas.
      for (int i = 0; i < 3; ++i) properties_.frontal_areas[i] += 0.25 * std::abs(triangles.area_vector(t)[i]);
  }
  auto& tensor = properties_.inertia;
  if (inertia_.empty()) {
    const bool elsewhere = length(properties_.middle) > 1e-6 * size;
    if (closed && !elsewhere)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) tensor[i][j] = properties_.mass / moments.volume * moments.inertia()[i][j];
    return;
  }
  if (inertia_.size() != 3 && inertia_.size() != 6)
    section.fail("needs three numbers, xx, yy, zz, or six, xx, yy, zz, yz, xz, xy", "inertia tensor");
  for (int i = 0; i < 3; ++i) tensor[i][i] = inertia_[i];
  if (inertia_.size() == 6)
    for (int i = 0; i < 3; ++i) tensor[(i + 1) % 3][(i + 2) % 3] = tensor[(i + 2) % 3][(i + 1) % 3] = inertia_[3 + i];
  const double minor = tensor[0][0] * tensor[1][1] - tensor[0][1] * tensor[0][1];
  const double whole =
      dot(Point{tensor[0][0], tensor[0][1], tensor[0][2]},
          cross(Point{tensor[1][0], tensor[1][1], tensor[1][2]}, Point{tensor[2][0], tensor[2][1], tensor[2][2]}));
  if (!(tensor[0][0] > 0 && minor > 0 && whole > 0))
    section.fail("is not that of a body: it must be positive definite", "inertia tensor");
}

std::shared_ptr<const BodyMotion> RigidBody::read_motion(const Section& section, const Registry<BodyMotion>& motions) {
  std::shared_ptr<const BodyMotion> motion = motions.create(section);
  if (motion->released()) {
    motion->released()->check_body(properties_, section);
    may_be_free_ = true;
  }
  if (contour_ && contour().extent() == ContourExtent::half && (motion->moves(0) || motion->turns()))
    section.fail("a body with a half contour cannot leave its axis: it has no motion in x");
  return motion;
}

int RigidBody::unknowns_per_body(Geometry geometry) {
  int count = 0;
  for (int direction = 0; direction < num_directions(geometry); ++direction) count += may_move(geometry, direction);
  return count;
}

void RigidBody::bind(const Space& space, int field, int index) {
  unknowns_.field = field;
  unknowns_.count = space.field(field).components;
  for (int direction = 0, k = 0; direction < num_directions(properties_.geometry); ++direction)
    if (may_move(properties_.geometry, direction)) unknowns_.direction[k++] = direction;
  for (int k = dimension(); k < unknowns_.count; ++k) {
    const int axis = axis_of_rotation(dimension(), unknowns_.direction[k]);
    const double inertia = dimension() == 2 ? properties_.moment_of_inertia : properties_.inertia[axis][axis];
    if (properties_.mass > 0 && inertia > 0) unknowns_.scale[k] = std::sqrt(properties_.mass / inertia);
  }
  for (int k = 0; k < unknowns_.count; ++k) unknowns_.dof[k] = space.point_dof(field, index) + k;
  unknowns_.owned = unknowns_.dof[0] < space.dofs()->num_owned_dofs();
}

void RigidBody::declare_state(StateStore& store) {
  ArrayInfo info = ArrayInfo::of_model("body/" + name_ + "/motion", {}).not_shown();
  for (int i = 0; i < dimension(); ++i)
    info.variables.push_back({std::string("displacement ") + axis_names[i], 1, "m"});
  for (int i = 0; i < dimension(); ++i) info.variables.push_back({std::string("velocity ") + axis_names[i], 1, "m/s"});
  info.variables.push_back({"moving time", 1, "s"});
  if (dimension() == 3) {
    for (int i = 0; i < 3; ++i) info.variables.push_back({std::string("rotation ") + axis_names[i], 1, "rad"});
    for (int i = 0; i < 3; ++i) info.variables.push_back({std::string("spin ") + axis_names[i], 1, "rad/s"});
    if (may_be_free_)  // values of the unknowns for which this rotation holds
      for (int i = 0; i < 3; ++i) info.variables.push_back({std::string("arc ") + axis_names[i], 1, "m"});
  }
  array_ = store.find(info.name);
  if (array_ < 0) array_ = store.declare(std::move(info));
}

bool RigidBody::set_motion(std::shared_ptr<const BodyMotion> motion) {
  std::swap(motion_, motion);
  return motion_ != motion;
}

void RigidBody::restart_clock(State& committed) const { committed.arrays[array_](0, 2 * dimension()) = 0; }

Rotation RigidBody::turn_of_row(const State& state) const {
  const PointView& row = state.arrays[array_];
  return Rotation::by({row(0, 7), row(0, 8), row(0, 9)}) * start_turn_;
}

Point RigidBody::increment(const State& state, const ConstNodalView* ahead) const {
  const PointView& row = state.arrays[array_];
  Point result{};
  for (int k = 3; k < unknowns_.count; ++k) {
    const int dof = unknowns_.dof[k];
    const double change = state.value(dof) - row(0, 10 + k) + (ahead ? (*ahead)(dof) : 0.0);
    result[k - 3] = change * unknowns_.scale[k];
  }
  return result;
}

BodyState RigidBody::state_of(const State& state) const {
  const PointView& row = state.arrays[array_];
  const int axes = dimension();
  BodyState result;
  result.turn = start_turn_;
  result.moving_time = row(0, 2 * axes);
  for (int i = 0; i < axes; ++i) {
    result.displacement[i] = row(0, i);
    result.velocity[i] = row(0, axes + i);
  }
  if (axes == 3) {
    result.turn = turn_of_row(state);
    result.spin = {row(0, 10), row(0, 11), row(0, 12)};
  }
  for (int k = 0; k < unknowns_.count; ++k) {
    const int direction = unknowns_.direction[k], dof = unknowns_.dof[k];
    if (direction < axes) {
      result.displacement[direction] = state.value(dof);
      result.velocity[direction] = state.rate(dof);
    } else if (axes == 2) {
      result.turn = Rotation::by({0, 0, state.value(dof) * unknowns_.scale[k]}) * start_turn_;
      result.spin[2] = state.rate(dof) * unknowns_.scale[k];
    } else {
      result.spin[direction - 3] = state.rate(dof) * unknowns_.scale[k];
    }
  }
  if (axes == 3 && unknowns_.count > 0) {
    result.turn = result.turn * Rotation::by_increment(increment(state, nullptr));
    result.spin = result.turn(result.spin);
  }
  return result;
}

BodyState RigidBody::prescribed(const State& committed, double t_old, double t_end) const {
  BodyState now = state_of(committed);
  if (motion_) return motion_->advance(now, t_old, t_end);
  now.velocity = now.spin = {};
  now.moving_time = 0;
  return now;
}

void RigidBody::prescribe(const State& committed, double t_old, double t_end, Constraints& to) const {
  if (unknowns_.count == 0) return;
  const BodyState end = prescribed(committed, t_old, t_end);
  const int axes = dimension();
  Point turned{}, spin{};
  if (axes == 3) {
    const Rotation now = state_of(committed).turn;
    // A body at rest stays in place to the last bit.
    const bool rests = std::equal(&now.matrix[0][0], &now.matrix[0][0] + 9, &end.turn.matrix[0][0]);
    if (!rests) turned = (now.inverse() * end.turn).increment();
    spin = end.turn.back(end.spin);
  }
  for (int k = 0; k < unknowns_.count; ++k) {
    const int dof = unknowns_.dof[k], direction = unknowns_.direction[k];
    if (releases(direction)) continue;
    if (direction < axes)
      to.prescribe(dof, end.displacement[direction], end.velocity[direction]);
    else if (axes == 2)
      to.prescribe(dof, committed.value(dof), 0);
    else
      to.prescribe(dof, committed.value(dof) + turned[direction - 3] / unknowns_.scale[k],
                   spin[direction - 3] / unknowns_.scale[k]);
  }
}

void RigidBody::advance(const StepView& view) const {
  const BodyState now = prescribed(*view.committed, view.time_old, view.time_end);
  const PointView& row = view.trial->arrays[array_];
  const int axes = dimension();
  row(0, 2 * axes) = now.moving_time;
  const bool unknown = unknowns_.count > 0;
  if (unknown && axes == 2) return;
  if (!unknown) {
    for (int i = 0; i < axes; ++i) {
      row(0, i) = now.displacement[i];
      row(0, axes + i) = now.velocity[i];
    }
  }
  if (axes == 3) turn_row(view, now);
}

void RigidBody::turn_row(const StepView& view, const BodyState& now) const {
  const PointView &row = view.trial->arrays[array_], &committed = view.committed->arrays[array_];
  const bool unknown = unknowns_.count > 0;
  // The unknowns rotate the body from its committed rotation.
  const Rotation turn = (unknown ? state_of(*view.committed) : now).turn, before = turn_of_row(*view.committed);
  const bool rests = std::equal(&turn.matrix[0][0], &turn.matrix[0][0] + 9, &before.matrix[0][0]);
  const Point turned = (turn * start_turn_.inverse()).vector();
  for (int i = 0; i < 3; ++i) {
    row(0, 7 + i) = rests ? committed(0, 7 + i) : turned[i];
    if (unknown)
      row(0, 13 + i) = view.committed->value(unknowns_.dof[3 + i]);
    else
      row(0, 10 + i) = now.spin[i];
  }
}

double RigidBody::speed(const State& state, double dt) const {
  if (!active() || !(dt > 0)) return 0;
  if (released()) {
    // The larger of the speeds now and at the end of the step with the present acceleration; a rotation moves the
    // body's farthest point.
    Point now{}, then{}, turning{}, turned{};
    for (int k = 0; k < unknowns_.count; ++k) {
      const int direction = unknowns_.direction[k];
      const double v = state.rate(unknowns_.dof[k]) * unknowns_.scale[k],
                   a = state.acceleration(unknowns_.dof[k]) * unknowns_.scale[k];
      const bool turns = direction >= dimension();
      const int axis = turns ? axis_of_rotation(dimension(), direction) : direction;
      (turns ? turning : now)[axis] = v;
      (turns ? turned : then)[axis] = v + a * dt;
    }
    return std::max(length(now), length(then)) + std::max(length(turning), length(turned)) * reach_;
  }
  constexpr int parts = 8;
  BodyState at = state_of(state);
  double fastest = 0;
  for (int i = 0; i < parts; ++i) {
    const double from = state.time + dt * i / parts, to = state.time + dt * (i + 1) / parts;
    const BodyState next = motion_->advance(at, from, to);
    const double path =
        length(next.displacement - at.displacement) + reach_ * length((next.turn * at.turn.inverse()).vector());
    fastest = std::max(fastest, path / (to - from));
    at = next;
  }
  return fastest;
}

BodyInstant RigidBody::initial_instant() const {
  BodyInstant result;
  result.position = constant_vector(position_);
  result.axes = BodyAxes(start_turn_);
  return result;
}

BodyPlacement RigidBody::placement(const State& state) const {
  const BodyState now = state_of(state);
  const bool turned_on = dimension() == 3 && unknowns_.count > 0;
  return {initial_placement().centre + now.displacement, now.turn, turned_on ? increment(state, nullptr) : Point{}};
}

BodyPlacement RigidBody::placement(const State& state, const ConstNodalView& ahead) const {
  BodyPlacement result = placement(state);
  for (int k = 0; k < unknowns_.count; ++k) {
    const int direction = unknowns_.direction[k];
    const double moved = ahead(unknowns_.dof[k]) * unknowns_.scale[k];
    if (direction < dimension())
      result.centre[direction] += moved;
    else if (dimension() == 2)
      result.turn = Rotation::by({0, 0, moved}) * result.turn;
  }
  if (dimension() == 2 || unknowns_.count == 0) return result;
  result.increment = increment(state, &ahead);
  result.turn = turn_of_row(state) * Rotation::by_increment(result.increment);
  return result;
}

Point BodyPlacement::turning(int component) const {
  // The increment is given along the body's axes before it; a rotation keeps its own axis.
  Point unit{};
  unit[component] = 1;
  const Rotation before = turn * Rotation::by_increment(increment).inverse();
  const Point turned = unit + 0.5 * cross(increment, unit);
  return before(1 / (1 + 0.25 * dot(increment, increment)) * turned);
}

Point RigidBody::position(const State& state) const {
  const BodyPlacement at = placement(state);
  return at.centre + arm(at);
}

Point RigidBody::displacement(const State& state) const {
  const BodyState now = state_of(state);
  return now.displacement + start_turn_(centre_) - now.turn(centre_);
}

Point RigidBody::velocity(const State& state) const {
  const BodyState now = state_of(state);
  return now.velocity - cross(now.spin, now.turn(centre_));
}

Point RigidBody::acceleration(const State& state) const {
  Point result{};
  for (int k = 0; k < unknowns_.count; ++k)
    if (unknowns_.direction[k] < dimension()) result[unknowns_.direction[k]] = state.acceleration(unknowns_.dof[k]);
  return result;
}

Point RigidBody::in_frame(const BodyPlacement& placement, const Point& x) const {
  return placement.turn.back(x - placement.centre) + centre_;
}

ContourProjection RigidBody::closest(const BodyPlacement& placement, const PlanePoint& x) const {
  const auto turned = [&](const PlanePoint& v) { return in_plane(placement.turn({v[0], v[1], 0})); };
  ContourProjection projection = contour().closest(in_plane(in_frame(placement, {x[0], x[1], 0})));
  const PlanePoint arm = turned({projection.point[0] - centre_[0], projection.point[1] - centre_[1]});
  for (int i = 0; i < 2; ++i) projection.point[i] = placement.centre[i] + arm[i];
  projection.normal = turned(projection.normal);
  projection.tangent = turned(projection.tangent);
  return projection;
}

SurfaceProjection RigidBody::projection(const BodyPlacement& placement, const Point& x) const {
  return PlacedSurface{surface_, placement.centre + arm(placement), placement.turn}.closest(x);
}

std::vector<Point> RigidBody::outline(const BodyPlacement& placement) const {
  std::vector<Point> result;
  for (const Point& x : outline_) result.push_back(from_frame(placement, x));
  return result;
}

Shadow RigidBody::shadow(const BodyPlacement& placement, const Point& direction) const {
  const Point along = placement.turn.back(direction);
  if (surface_) return shadow_in_space(outline_, along);
  const double width = extent_along(outline_, {-along[1], along[0], 0});
  return {width, width};
}

double RigidBody::own_height() const {
  Point up{};
  up[dimension() - 1] = 1;
  return extent_along(outline_, up);
}

double RigidBody::largest_displacement(const BodyPlacement& from, const BodyPlacement& to) const {
  double longest = 0;
  for (const Point& x : outline_) longest = std::max(longest, length(from_frame(to, x) - from_frame(from, x)));
  return longest;
}

double RigidBody::gap(const BodyPlacement& placement, const Point& x) const {
  const Point own = in_frame(placement, x);
  return surface_ ? surface_->closest(own).gap : contour().closest(in_plane(own)).gap;
}

double RigidBody::height(const BodyPlacement& placement, const Point& x) const {
  return in_frame(placement, x)[dimension() - 1];
}

}  // namespace mudline
