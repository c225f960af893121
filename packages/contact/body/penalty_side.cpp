#include "contact/body/penalty_side.hpp"

namespace mudline {

namespace {

/// A side and the body next to it as numbers of kind T: with their derivatives by the side's dofs.
template <class T>
struct SideNumbers {
  explicit SideNumbers(const SideContact& side) : centre(constant<T>(side.placement.centre)) {
    const int nodes = side.rule.nodes, first_body = 2 * nodes + side.pressure_nodes;
    for (int a = 0; a < nodes; ++a) node[a] = unknown<T>(side.x[a], 2 * a);
    for (int a = 0; a < side.pressure_nodes; ++a) pressure[a] = unknown<T>(side.pressure[a], 2 * nodes + a);
    const BodyUnknowns& body = side.body.unknowns();
    for (int k = 0; k < body.count; ++k)
      (body.direction[k] == 0   ? centre.x
       : body.direction[k] == 1 ? centre.y
                                : turn) += body.scale[k] * unknown<T>(0.0, first_body + k);
  }
  PlaneVector<T> node[max_side_nodes], centre;
  T turn{0.0};  // [rad] of the body beyond its angle: 0, with derivatives
  T pressure[max_side_nodes], area[max_contact_points];
};

/// Where a point is beside the body.
template <class T>
struct BodyFoot {
  BodyFoot(const ContourFoot& at, const PlaneVector<T>& from_centre, const T& turn) : arm(from_centre) {
    // how the point moves past the material of the body: 0, with derivatives
    const PlaneVector<T> way{arm.x - value(arm.x) + turn * value(arm.y), arm.y - value(arm.y) - turn * value(arm.x)};
    const PlaneVector<T> n = constant<T>(at.normal), m = constant<T>(at.tangent);
    const T along = dot(m, way), turned = at.turning * along + turn;
    gap = at.gap + dot(n, way);
    advance = at.travel * along;
    normal = n + m * turned;
    tangent = m - n * turned;
  }
  T gap, advance;  // [m]; of the foot along the contour: 0, with derivatives
  PlaneVector<T> normal, tangent, arm;
};

/// Forces by dof.
template <class T>
struct SideForces : StepForces<T, max_side_dofs> {
  explicit SideForces(const SideContact& of) : side(of) {}
  /// A force on the soil at point c with its moment about the body's centre.
  void add(int c, const PlaneVector<T>& force, const T& moment, T (&to)[max_side_dofs]) const {
    spread(side.rule.nodes, side.rule.shape[c].data(), force, to);
    const BodyUnknowns& body = side.body.unknowns();
    const int first_body = 2 * side.rule.nodes + side.pressure_nodes;
    for (int k = 0; k < body.count; ++k)
      to[first_body + k] -= body.scale[k] * (body.direction[k] == 0   ? force.x
                                             : body.direction[k] == 1 ? force.y
                                                                      : moment);
  }
  const SideContact& side;
};

template <class T>
T pore_pressure(const SideContact& side, int c, const SideNumbers<T>& x) {
  T result(side.start[c].soil.pore_pressure);
  double shape[max_side_nodes], slope[max_side_nodes];
  if (side.pressure_nodes > 0) evaluate_line(side.pressure_nodes, side.rule.xi[c], shape, slope);
  for (int a = 0; a < side.pressure_nodes; ++a) result += shape[a] * x.pressure[a];
  return result;
}

template <class T>
ContactMotion<T> motion_of_point(const SideContact& side, int c, const SideNumbers<T>& x, const ContourFoot& at,
                                 const BodyFoot<T>& foot) {
  const ContactStart& start = side.start[c];
  ContactMotion<T> motion;
  motion.gap = foot.gap;
  motion.area = x.area[c];
  motion.shift = T(start.shift);
  motion.member = start.member;
  motion.soil = start.soil;
  motion.pore_pressure = pore_pressure(side, c, x);
  const bool shears = side.law.friction && presses(side.law, motion);
  if (!shears && !side.law.conserves && !(side.law.viscous > 0)) return motion;
  motion.position = side.rule.place(c, side.x_old);
  const ContourFoot before = side.body.closest(side.placement_old, motion.position);
  motion.gap_old = T(before.gap);
  motion.force_old = T(start.normal_force);
  if (!shears) return motion;
  motion.opened = T(before.gap - start.shift_old);
  motion.travel = foot.advance + side.body.contour().distance(before, at);
  motion.shear_old = T(start.shear.shear);
  motion.slip_old = start.shear.slip;
  motion.slid = start.shear.slides;
  return motion;
}

/// What a point's response means in forces.
template <class T>
void add_forces(const SideContact& side, int c, const BodyFoot<T>& foot, const ContactResponse<T>& now, const T& area,
                ContactPoint& point, SideForces<T>& to) {
  const PlaneVector<T> friction = foot.tangent * (now.shear * area),
                       force = foot.normal * (now.pressure * area) + friction, damping = foot.normal * now.damping;
  const T moment = cross(foot.arm, force);
  to.add(c, force, moment, to.end);
  if (side.law.conserves) {
    const PointForce& old = side.start[c].force;
    const T more = now.end_share - (1 - side.law.start_weight), less = now.start_share - side.law.start_weight;
    to.add(c, force * more, moment * more, to.more);
    to.add(c, {less * old[0], less * old[1]}, less * old[2], to.more);
  }
  if (side.law.viscous > 0) to.add(c, damping, cross(foot.arm, damping), to.more);
  for (int i = 0; i < 2; ++i) {
    point.force[i] = plain(force)[i];
    point.friction[i] = plain(friction)[i];
    point.damping[i] = plain(damping)[i];
  }
  point.moment = value(moment);
}

template <class T>
ContactPoint evaluate_point(const SideContact& side, int c, const SideNumbers<T>& x, SideForces<T>& forces) {
  const PlaneVector<T> at = combine(side.rule.nodes, side.rule.shape[c].data(), x.node);
  const ContourFoot nearest = side.body.closest(side.placement, plain(at));
  const BodyFoot<T> foot(nearest, at - x.centre, x.turn);
  const ContactMotion<T> motion = motion_of_point(side, c, x, nearest, foot);
  ContactResponse<T> now = respond(side.law, motion);
  const bool reached = !now.presses && nearest.gap < side.reach;
  if (reached) now.pressure = chain(foot.gap, 0.0, -side.reach_share * side.law.penalty);
  ContactPoint point{};
  point.gap = nearest.gap;
  point.pressure = value(now.pressure);
  point.area = value(motion.area);
  point.active = now.presses;
  point.height = side.body.height(side.placement, plain(at));
  point.damped = now.damping_heat;
  const ShearState& old = side.start[c].shear;  // slip and heat stay when the shear stress goes
  point.shear = {value(now.shear), old.slip + now.slip, old.dissipated + now.heat, now.slides};
  if (now.presses || reached || side.law.conserves || side.law.viscous > 0)
    add_forces(side, c, foot, now, motion.area, point, forces);
  return point;
}

template <class T>
bool evaluate_side(const SideContact& side, SideForce& out, std::vector<ContactPoint>& points) {
  SideNumbers<T> x(side);
  SideForces<T> forces(side);
  if (!contact_areas(side.rule, x.node, side.geometry, x.area)) return false;
  for (int c = 0; c < side.rule.points; ++c) points[c] = evaluate_point(side, c, x, forces);
  forces.write(T(1.0), 1 / (1 - side.law.start_weight), out.f, out.correction, out.k);
  return true;
}

}  // namespace

bool penalty_side(const SideContact& side, bool want_tangent, SideForce& out, std::vector<ContactPoint>& points) {
  out = {};
  points.assign(side.rule.points, {});
  return want_tangent ? evaluate_side<Dual<max_side_dofs>>(side, out, points)
                      : evaluate_side<double>(side, out, points);
}

}  // namespace mudline
