#include "contact/body/rigid_target.hpp"

#include <algorithm>

#include "contact/conjugate_position.hpp"

namespace mudline {

namespace {

/// What a point of the plane or of space sees of a body, see PointAction. The motions are the displacement of the point
/// against the material of the body, and the rotation of the body [rad], both 0 with derivatives.
template <class T, int D>
struct BodySeen;

template <class T>
struct BodySeen<T, 2> {
  static constexpr int motions = 3, most_dofs = 3;

  BodySeen(const BodyInStep& step_, const PointInStep& point, const ContourProjection& now_)
      : step(step_), now(now_), arm{point.place[0] - step.now.centre[0], point.place[1] - step.now.centre[1]} {
    const T turn = unknown<T>(0.0, 2);
    const Vec<T, 2> displacement = unknown<T>(PlanePoint{}, 0), n = constant<T>(now.normal),
                    m{T(-now.normal[1]), T(now.normal[0])};
    const T along = dot(m, displacement), turned = now.turning * along + turn;
    gap = now.gap + dot(n, displacement) - point.old.offset;
    advance = now.travel * along;
    normal = n + m * turned;
    tangent = m - n * turned;
    from_centre = {arm[0] + displacement[0] - turn * arm[1], arm[1] + displacement[1] + turn * arm[0]};
  }

  void look_back(const PointInStep& point) {
    before = step.body.closest(step.old, in_plane(point.place_old));
    gap_old = before.gap - point.old.offset;
  }
  /// The travel counts from the closest point at the start of the step, along the contour.
  void start(const PointInStep& point, ContactMotion<T, 2>& motion) const {
    motion.opened = T(gap_old - point.old.shift_old);
    motion.travel = advance + step.body.contour().distance(before, now);
    motion.shear_old = T(point.old.shear.shear[0]);
    motion.slid = point.old.shear.slides;
  }
  const T& sliding() const { return advance; }
  Vec<T, 2> traction(const T& shear) const { return tangent * shear; }
  void forces(const Vec<T, 2>& force, T* f) const {
    const BodyUnknowns& unknowns = step.body.unknowns();
    for (int k = 0; k < unknowns.count; ++k) {
      const int direction = unknowns.direction[k];
      f[k] = -unknowns.scale[k] * (direction < 2 ? force[direction] : cross(from_centre, force));
    }
  }
  void spread(const T& number, double* column) const {
    const BodyUnknowns& unknowns = step.body.unknowns();
    const double* const d = number.d;
    for (int k = 0; k < unknowns.count; ++k) {
      const int direction = unknowns.direction[k];
      column[k] = unknowns.scale[k] * (direction < 2 ? -d[direction] : d[2] + arm[1] * d[0] - arm[0] * d[1]);
    }
  }

  static double weight(int) { return 1; }
  static double rounding(double) { return 1; }

  const BodyInStep& step;
  const ContourProjection& now;
  ContourProjection before{};
  PlanePoint arm;      // [m] from the body's centre
  T gap, advance;      // [m]; advance: of the closest point along the contour, 0 with derivatives
  double gap_old = 0;  // [m]
  Vec<T, 2> normal, tangent, from_centre;
};

template <class T>
struct BodySeen<T, 3> {
  static constexpr int motions = 6, most_dofs = body_directions;
  using Vector = Vec<T, 3>;

  BodySeen(const BodyInStep& step_, const PointInStep& point, const SurfaceProjection& now)
      : step(step_), arm(point.place - step.now.centre) {
    for (int i = 0; i < 3; ++i) {
      displacement[i] = unknown<T>(0.0, i);
      turn[i] = unknown<T>(0.0, 3 + i);
    }
    from_centre = rotated(arm) + displacement;
    gap = now.gap + dot(constant<T, 3>(now.normal), displacement);
    normal = rotated(now.normal);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) normal[i] += now.turning[i][j] * displacement[j];
    closest = from_centre - normal * gap;
    gap = gap - point.old.offset;
  }

  void look_back(const PointInStep& point) {
    before = step.body.projection(step.old, point.place_old);
    gap_old = before.gap - point.old.offset;
  }
  /// The travel is the path of the closest point over the body, as a vector in the tangent plane at its end. The old
  /// shear stress rotates with the body and then with the normal.
  void start(const PointInStep& point, ContactMotion<T, 3>& motion) const {
    motion.opened = T(gap_old - point.old.shift_old);
    const Rotation turned = step.now.turn * step.old.turn.inverse();
    const Vector from = rotated(turned(before.normal));
    const Vector way = closest - rotated(turned(before.point - step.old.centre));
    const Vector sum = from + normal, middle = sum / length(sum);
    motion.travel = transported(way - middle * dot(way, middle), middle, normal);
    motion.shear_old = transported(rotated(turned(point.old.shear.shear)), from, normal);
    motion.slid = point.old.shear.slides;
  }
  Vector sliding() const { return displacement - normal * dot(normal, displacement); }
  const Vector& traction(const Vector& shear) const { return shear; }
  /// Moments are those about the body's own axes, about which its unknowns turn it.
  void forces(const Vector& force, T* f) const {
    const BodyUnknowns& unknowns = step.body.unknowns();
    Vector moment = Vector::zero();
    if (unknowns.count > 0) moment = cross(from_centre, force);
    for (int k = 0; k < unknowns.count; ++k) {
      const int direction = unknowns.direction[k];
      f[k] = -unknowns.scale[k] * (direction < 3 ? force[direction] : dot(rotated(axis(direction - 3)), moment));
    }
  }
  void spread(const T& number, double* column) const {
    const BodyUnknowns& unknowns = step.body.unknowns();
    const Point moved{number.d[0], number.d[1], number.d[2]}, turned{number.d[3], number.d[4], number.d[5]};
    for (int k = 0; k < unknowns.count; ++k) {
      const int direction = unknowns.direction[k];
      if (direction < 3) {
        column[k] = -unknowns.scale[k] * moved[direction];
      } else {
        const Point& about = step.turning[direction - 3];
        column[k] = unknowns.scale[k] * (dot(about, turned) - dot(cross(about, arm), moved));
      }
    }
  }

  static double weight(int) { return 1; }
  static double rounding(double) { return 1; }

  const BodyInStep& step;
  SurfaceProjection before{};
  Point arm;                            // [m] from the body's centre
  T gap;                                // [m]
  double gap_old = 0;                   // [m]
  Vector normal, closest, from_centre;  // [-]; [m] from the body's centre

 private:
  /// A vector fixed to the body, with its derivatives by the body's rotation.
  Vector rotated(const Point& x) const {
    const Vector plain = constant<T, 3>(x);
    return plain + cross(turn, plain);
  }
  Point axis(int k) const {
    Point result;
    for (int j = 0; j < 3; ++j) result[j] = step.now.turn.matrix[j][k];
    return result;
  }
  Vector turn, displacement;
};

}  // namespace

int* RigidTarget::write_dofs(int, int* to) const {
  return std::copy_n(body_->unknowns().dof, body_->unknowns().count, to);
}

std::vector<StateVariable> RigidTarget::columns() const {
  std::vector<StateVariable> result = {{"height", 1, "m"}};
  if (body_->dimension() == 2)
    result.push_back({"moment", 1, "N m", Transfer::total});
  else
    for (const char* axis : axis_names) result.push_back({std::string("moment ") + axis, 1, "N m", Transfer::total});
  return result;
}

void RigidTarget::write(const TargetPlace&, const ContactPoint& point, double* columns) const {
  columns[0] = point.height;
  if (body_->dimension() == 2)
    columns[1] = point.moment[2];
  else
    std::copy_n(point.moment.data(), 3, columns + 1);
}

Point RigidTarget::moment(const double* columns) const {
  return body_->dimension() == 2 ? Point{0, 0, columns[1]} : Point{columns[1], columns[2], columns[3]};
}

void RigidTarget::move(const StepView& view, bool ahead) {
  if (ahead) {
    step_.old = moved_ahead(*body_, *view.committed, view.impact.ahead_old, view.impact.lead);
    step_.now = moved_ahead(*body_, *view.trial, view.impact.ahead_end, view.impact.lead);
  } else {
    step_.old = body_->placement(*view.committed);
    step_.now = body_->placement(*view.trial);
  }
  for (int k = 0; body_->surface() && k < 3; ++k) step_.turning[k] = step_.now.turning(k);
}

double RigidTarget::least_gap(const Bounds& box) const {
  const Point across = box.high - box.low;
  return body_->gap(step_.now, box.low + 0.5 * across) - 0.5 * length(across);
}

std::vector<int> RigidTarget::near(const Bounds& box, double distance) const {
  if (least_gap(box) <= distance) return {0};
  return {};
}

bool RigidTarget::find(const std::vector<int>& candidates, const Point& at, const Point&, double,
                       const ConstCoordinateView&, TargetPlace& place) const {
  if (candidates.empty()) return false;
  place.piece = 0;
  if (body_->dimension() == 2) {
    place.gap = place.projection.emplace<ContourProjection>(body_->closest(step_.now, in_plane(at))).gap;
  } else {
    place.gap = place.projection.emplace<SurfaceProjection>(body_->projection(step_.now, at)).gap;
  }
  return true;
}

void RigidTarget::complete(const TargetPlace& place, const Point& at, const ConstCoordinateView&,
                           ContactPoint& point) const {
  if (const auto* in_space = std::get_if<SurfaceProjection>(&place.projection))
    point.normal = in_space->normal;
  else
    point.normal = plain(std::get<ContourProjection>(place.projection).normal);
  point.height = body_->height(step_.now, at);
  point.moment = cross(at - step_.now.centre, point.force);
}

ContactPoint RigidTarget::act(const PointInStep& point, const TargetPlace& place, SideAction& to) const {
  ContactPoint result = body_->dimension() == 2
                            ? act_on<BodySeen, 2>(step_, point, std::get<ContourProjection>(place.projection), to)
                            : act_on<BodySeen, 3>(step_, point, std::get<SurfaceProjection>(place.projection), to);
  complete(place, point.place, point.x, result);
  return result;
}

void RigidTarget::old_forces(const double* columns, const Point& force, double* on_target) const {
  const BodyUnknowns& unknowns = body_->unknowns();
  const int axes = body_->dimension();
  const Point world = moment(columns), turning = axes == 2 ? Point{world[2], 0, 0} : step_.old.turn.back(world);
  for (int k = 0; k < unknowns.count; ++k) {
    const int direction = unknowns.direction[k];
    on_target[k] = -unknowns.scale[k] * (direction < axes ? force[direction] : turning[direction - axes]);
  }
}

}  // namespace mudline
