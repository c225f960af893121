#include "contact/body/penalty_side.hpp"

#include <cmath>

namespace mudline {

namespace {

/// Derivatives of the shear stress of one point.
struct ShearTangent {
  double x[2] = {0, 0};                  // [Pa/m] with respect to its position
  double pressure[max_side_nodes] = {};  // [-] with respect to the nodes' pore pressures
};

/// Friction at a point that presses: adds to its force, fills its shear state.
void add_friction(const ContactRule& rule, int c, const RigidBody& body, const SideStart& start,
                  const SideFriction& side, double penalty, const SideShift& shift, const ContourFoot& foot,
                  ContactPoint& point, ShearTangent& tangent) {
  const PlanePoint at_old = rule.place(c, start.x);
  const ContourFoot foot_old = body.closest(start.placement, at_old);
  const TouchingTravel travel(foot_old.gap - shift.old[c], foot.gap - shift.now[c],
                              body.contour().distance(foot_old, foot));
  double shape[max_side_nodes] = {}, slope[max_side_nodes], pore_pressure = 0;
  if (side.pressure_nodes > 0) evaluate_line(side.pressure_nodes, rule.xi[c], shape, slope);
  for (int a = 0; a < side.pressure_nodes; ++a) pore_pressure += shape[a] * side.pressure[a];
  const ShearState& old = side.old[c];
  ShearResponse response =
      stick_or_slide(side.law, old, side.stiffness, travel.value, side.dt,
                     {point.pressure - pore_pressure, at_old, old.slip, side.time, std::abs(travel.value) / side.dt});
  if (side.first_guess) {  // what slid slides on, under the same stress; what stuck sticks
    const double stiffness = old.slides ? 0.0 : side.stiffness;
    response = {old, -stiffness, 0};
    response.now.shear -= stiffness * travel.value;
  }
  point.shear = response.now;
  point.shear.dissipated += std::abs(response.now.shear) * (response.now.slip - old.slip) * point.area;
  for (int i = 0; i < 2; ++i) {
    point.friction[i] = response.now.shear * foot.tangent[i] * point.area;
    point.force[i] += point.friction[i];
    tangent.x[i] =
        response.elastic * (travel.fraction * foot.travel * foot.tangent[i] + travel.gap_slope * foot.normal[i]) -
        response.normal * penalty * foot.normal[i];
  }
  for (int a = 0; a < side.pressure_nodes; ++a) tangent.pressure[a] = -response.normal * shape[a];
}

/// How a point that is fixed to the body moves with each of the body's unknowns.
struct BodyWays {
  BodyWays(const BodyUnknowns& unknowns, const PlanePoint& arm) : count(unknowns.count) {
    for (int k = 0; k < count; ++k) {
      const int direction = unknowns.direction[k];
      turn[k] = direction == 2 ? unknowns.scale[k] : 0.0;
      way[k] = direction == 0   ? PlanePoint{1, 0}
               : direction == 1 ? PlanePoint{0, 1}
                                : PlanePoint{-turn[k] * arm[1], turn[k] * arm[0]};
      shift[k] = direction < 2 ? way[k] : PlanePoint{0, 0};
    }
  }
  double along(int k, const double (&force)[2]) const { return way[k][0] * force[0] + way[k][1] * force[1]; }
  double along(int k, const PointForce& force) const {
    return shift[k][0] * force[0] + shift[k][1] * force[1] + turn[k] * force[2];
  }
  int count;
  PlanePoint way[body_directions], shift[body_directions];  // of the point; of the centre
  double turn[body_directions];                             // [1/m] d angle / d unknown
};

/// One contact point of a side: spreads forces and their derivatives to the nodes and to the body.
class PointAssembly {
 public:
  PointAssembly(const ContactRule& rule, int c, const BodyWays& ways, int first_body, SideForce& out)
      : rule_(rule), c_(c), ways_(ways), first_body_(first_body), out_(out) {}

  /// A force at the point, or one that was recorded with its moment.
  template <class Force>
  void add_force(const Force& force, double factor, double (&to)[max_side_dofs]) const {
    for (int i = 0; i < 2; ++i)
      for (int a = 0; a < rule_.nodes; ++a) to[2 * a + i] += factor * rule_.shape[c_][a] * force[i];
    for (int k = 0; k < ways_.count; ++k) to[first_body_ + k] -= factor * ways_.along(k, force);
  }
  /// d gap by dof.
  double gap_slope(int b, const PlanePoint& normal) const {
    if (b < 2 * rule_.nodes) return rule_.shape[c_][b / 2] * normal[b % 2];
    if (b < first_body_) return 0;
    const PlanePoint& way = ways_.way[b - first_body_];
    return -(normal[0] * way[0] + normal[1] * way[1]);
  }
  /// change[i][b]: derivative of the point's force.
  void add_tangent(const double (&change)[2][max_side_dofs]) const {
    for (int b = 0; b < first_body_ + ways_.count; ++b) {
      for (int a = 0; a < rule_.nodes; ++a)
        for (int i = 0; i < 2; ++i) out_.k[2 * a + i][b] += rule_.shape[c_][a] * change[i][b];
      const double column[2] = {change[0][b], change[1][b]};
      for (int k = 0; k < ways_.count; ++k) out_.k[first_body_ + k][b] -= ways_.along(k, column);
    }
  }
  /// The arm of the moment follows the point and the centre: d(way . force) = turn d(arm) x force.
  void add_arm_change(const double (&force)[2], double factor) const {
    for (int k = 0; k < ways_.count; ++k) {
      if (ways_.turn[k] == 0) continue;
      const double slope[2] = {factor * ways_.turn[k] * force[1], -factor * ways_.turn[k] * force[0]};  // by the arm
      for (int j = 0; j < 2; ++j) {
        for (int b = 0; b < rule_.nodes; ++b) out_.k[first_body_ + k][2 * b + j] -= slope[j] * rule_.shape[c_][b];
        for (int b = 0; b < ways_.count; ++b) out_.k[first_body_ + k][first_body_ + b] += slope[j] * ways_.shift[b][j];
      }
    }
  }
  /// A recorded force whose share changes with the gap.
  void add_old_tangent(const PointForce& force, double share_slope, const PlanePoint& normal) const {
    for (int b = 0; b < first_body_ + ways_.count; ++b) {
      const double change = share_slope * gap_slope(b, normal);
      for (int i = 0; i < 2; ++i)
        for (int a = 0; a < rule_.nodes; ++a) out_.k[2 * a + i][b] += change * rule_.shape[c_][a] * force[i];
      for (int k = 0; k < ways_.count; ++k) out_.k[first_body_ + k][b] -= change * ways_.along(k, force);
    }
  }

 private:
  const ContactRule& rule_;
  int c_;
  const BodyWays& ways_;
  int first_body_;
  SideForce& out_;
};

/// Derivatives of a point's force with respect to each dof.
void point_tangent(const ContactRule& rule, int c, const SideAreas& areas, double penalty, const ContourFoot& foot,
                   const ContactPoint& point, const ShearTangent& shear, const BodyWays& ways, int pressures,
                   double (&change)[2][max_side_dofs]) {
  const int first_body = 2 * rule.nodes + pressures;
  for (int i = 0; i < 2; ++i) {
    const double traction = point.pressure * foot.normal[i] + point.shear.shear * foot.tangent[i];
    // d(t n + s m)/dx with dn = turning m (m . dx), dm = -turning n (m . dx)
    const double across = point.pressure * foot.tangent[i] - point.shear.shear * foot.normal[i];
    for (int j = 0; j < 2; ++j) {
      const double slope = foot.turning * across * foot.tangent[j] - penalty * foot.normal[i] * foot.normal[j] +
                           foot.tangent[i] * shear.x[j];
      for (int b = 0; b < rule.nodes; ++b)
        change[i][2 * b + j] = slope * rule.shape[c][b] * point.area + traction * areas.variation[c][2 * b + j];
      // what moves the point one way moves the body the other way
      for (int k = 0; k < ways.count; ++k) change[i][first_body + k] -= slope * ways.way[k][j] * point.area;
    }
    for (int k = 0; k < ways.count; ++k) change[i][first_body + k] += ways.turn[k] * across * point.area;
    for (int b = 0; b < pressures; ++b)
      change[i][2 * rule.nodes + b] = foot.tangent[i] * shear.pressure[b] * point.area;
  }
}

/// Damping of a point, also of one that left in the step.
void add_damping(const ContactRule& rule, int c, const SideAreas& areas, double penalty, const SideStep& step,
                 const StepShares& share, double gap_old, const PlanePoint& arm, const ContourFoot& foot,
                 const BodyWays& ways, int first_body, const PointAssembly& add, bool want_tangent, SideForce& out,
                 ContactPoint& point) {
  const double end = point.active ? point.pressure * point.area : 0.0,
               mean = share.start.value * step.normal_old[c] + share.end.value * end;
  const ContactDamping damping = contact_damping(step.viscous, gap_old, foot.gap, step.dt);
  for (int i = 0; i < 2; ++i) point.damping[i] = damping.factor * mean * foot.normal[i];
  point.damped = damping.factor * mean * (gap_old - foot.gap);
  const PointForce force{point.damping[0], point.damping[1], arm[0] * point.damping[1] - arm[1] * point.damping[0]};
  add.add_force(force, 1, out.correction);
  if (!want_tangent) return;
  const double weight = 1 / (1 - step.alpha_f);
  const double by_gap =
      damping.slope * mean + damping.factor * (share.start.slope * step.normal_old[c] + share.end.slope * end);
  double change[2][max_side_dofs] = {};
  for (int b = 0; b < first_body + ways.count; ++b) {
    if (b >= 2 * rule.nodes && b < first_body) continue;  // pressures
    double size = by_gap * add.gap_slope(b, foot.normal);
    if (point.active) size -= damping.factor * share.end.value * penalty * add.gap_slope(b, foot.normal) * point.area;
    if (point.active && b < first_body)
      size += damping.factor * share.end.value * point.pressure * areas.variation[c][b];
    // the normal turns along the contour, and with the body
    const double turned =
        b < first_body ? foot.turning * foot.tangent[b % 2] * rule.shape[c][b / 2]
                       : ways.turn[b - first_body] - foot.turning * (foot.tangent[0] * ways.way[b - first_body][0] +
                                                                     foot.tangent[1] * ways.way[b - first_body][1]);
    for (int i = 0; i < 2; ++i)
      change[i][b] = weight * (size * foot.normal[i] + damping.factor * mean * turned * foot.tangent[i]);
  }
  add.add_tangent(change);
  add.add_arm_change(point.damping, weight);
}

}  // namespace

bool penalty_side(const ContactRule& rule, const SideBody& against, const NormalLaw& law, double penalty,
                  const SideFriction* friction, const SideStep& step, const SideShift& shift, const SideCoordinates& x,
                  bool axisymmetric, bool want_tangent, SideForce& out, std::vector<ContactPoint>& points) {
  const RigidBody& body = against.body;
  const int pressures = friction ? friction->pressure_nodes : 0, first_body = 2 * rule.nodes + pressures;
  out = {};
  points.assign(rule.points, {});
  SideAreas areas;
  if (!areas.compute(rule, x, axisymmetric)) return false;
  for (int c = 0; c < rule.points; ++c) {
    const PlanePoint at = rule.place(c, x);
    const ContourFoot foot = body.closest(against.placement, at);
    ContactPoint& point = points[c];
    point.gap = foot.gap;
    point.area = areas.area[c];
    const double pressed = foot.gap - shift.now[c];  // the gap at which the pressure is penalty <-pressed>
    point.active = shift.fixed ? shift.member[c] : pressed < 0;
    point.height = body.height(against.placement, at);
    if (friction) {  // slip and heat stay when the shear stress goes
      point.shear.slip = friction->old[c].slip;
      point.shear.dissipated = friction->old[c].dissipated;
    }
    const PlanePoint arm{at[0] - against.placement.centre[0], at[1] - against.placement.centre[1]};
    const BodyWays ways(body.unknowns(), arm);
    const PointAssembly add(rule, c, ways, first_body, out);
    const bool conserves = step.old != nullptr;
    const double gap_start =
        conserves || step.viscous > 0 ? body.closest(against.start.placement, rule.place(c, against.start.x)).gap : 0.0;
    const double gap_old = gap_start - shift.old[c];
    const StepShares shares =
        conserves ? conserving_shares(gap_old, pressed, step.impact_damping) : interpolated_shares(step.alpha_f);
    if (conserves) {
      add.add_force(step.old[c], shares.start.value - step.alpha_f, out.correction);
      if (want_tangent && shares.start.slope != 0)
        add.add_old_tangent(step.old[c], shares.start.slope / (1 - step.alpha_f), foot.normal);
    }
    const NormalPressure normal =
        point.active ? law.at(-pressed, penalty) : NormalPressure{0, against.touch_share * penalty};
    point.pressure = normal.value;
    if (step.viscous > 0)
      add_damping(rule, c, areas, normal.slope, step, shares, gap_start, arm, foot, ways, first_body, add, want_tangent,
                  out, point);
    if (!point.active && (!want_tangent || foot.gap >= against.touch)) continue;
    ShearTangent shear;
    if (point.active) {
      for (int i = 0; i < 2; ++i) point.force[i] = point.pressure * foot.normal[i] * point.area;
      if (friction) add_friction(rule, c, body, against.start, *friction, normal.slope, shift, foot, point, shear);
    }
    point.moment = arm[0] * point.force[1] - arm[1] * point.force[0];
    ImpactShare share{1, 0};  // of the end's part in the alpha level
    if (conserves && point.active) {
      add.add_force(point.force, shares.end.value - (1 - step.alpha_f), out.correction);
      share = {shares.end.value / (1 - step.alpha_f), shares.end.slope / (1 - step.alpha_f)};
    }
    add.add_force(point.force, 1, out.f);
    if (!want_tangent) continue;
    double change[2][max_side_dofs] = {};
    point_tangent(rule, c, areas, normal.slope, foot, point, shear, ways, pressures, change);
    for (int i = 0; i < 2; ++i)
      for (int b = 0; b < first_body + ways.count; ++b)
        change[i][b] = share.value * change[i][b] + share.slope * point.force[i] * add.gap_slope(b, foot.normal);
    add.add_tangent(change);
    add.add_arm_change(point.force, share.value);
  }
  return true;
}

}  // namespace mudline
