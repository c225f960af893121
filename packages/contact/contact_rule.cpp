#include "contact/contact_rule.hpp"

#include <cmath>

namespace mudline {

namespace {
constexpr double pi = 3.14159265358979323846;
}

ContactRule::ContactRule(ContactPoints kind, int nodes_, int degree) : nodes(nodes_) {
  const QuadratureRule gauss = line_quadrature(degree);
  samples = static_cast<int>(gauss.weights.size());
  N.assign(samples, {});
  dN.assign(samples, {});
  for (int q = 0; q < samples; ++q) evaluate_line(nodes, gauss.points[q][0], N[q].data(), dN[q].data());
  const bool nodal = kind == ContactPoints::nodes;
  points = nodal ? nodes : samples;
  shape.assign(points, {});
  weight.assign(points, std::vector<double>(samples, 0.0));
  for (int c = 0; c < points; ++c) {
    if (nodal) {
      constexpr double node_xi[max_side_nodes] = {-1, 1, 0};
      xi.push_back(node_xi[c]);
      shape[c][c] = 1;
      for (int q = 0; q < samples; ++q) weight[c][q] = gauss.weights[q] * N[q][c];
    } else {
      xi.push_back(gauss.points[c][0]);
      shape[c] = N[c];
      weight[c][c] = gauss.weights[c];
    }
  }
}

bool SideAreas::compute(const ContactRule& rule, const SideCoordinates& x, bool axisymmetric) {
  area.assign(rule.points, 0.0);
  variation.assign(rule.points, {});
  for (int q = 0; q < rule.samples; ++q) {
    double tangent[2] = {0, 0}, r = 0;
    for (int a = 0; a < rule.nodes; ++a) {
      for (int i = 0; i < 2; ++i) tangent[i] += rule.dN[q][a] * x[a][i];
      r += rule.N[q][a] * x[a][0];
    }
    const double stretch = std::hypot(tangent[0], tangent[1]);
    if (!(stretch > 0) || (axisymmetric && !(r >= 0))) return false;
    const double round = axisymmetric ? 2 * pi * r : 1.0;
    for (int c = 0; c < rule.points; ++c) {
      const double w = rule.weight[c][q];
      if (w == 0) continue;
      area[c] += w * stretch * round;
      for (int b = 0; b < rule.nodes; ++b) {
        for (int j = 0; j < 2; ++j) variation[c][2 * b + j] += w * round * tangent[j] / stretch * rule.dN[q][b];
        if (axisymmetric) variation[c][2 * b] += w * stretch * 2 * pi * rule.N[q][b];
      }
    }
  }
  return true;
}

namespace {

PlanePoint at_point(const ContactRule& rule, int c, const SideCoordinates& x) {
  PlanePoint at{};
  for (int a = 0; a < rule.nodes; ++a)
    for (int i = 0; i < 2; ++i) at[i] += rule.shape[c][a] * x[a][i];
  return at;
}

/// Derivatives of the shear stress of one point.
struct ShearTangent {
  double x[2] = {0, 0};                  // [Pa/m] with respect to its position
  double pressure[max_side_nodes] = {};  // [-] with respect to the nodes' pore pressures
};

/// Friction at a point that presses: adds to its force, fills its shear state.
void add_friction(const ContactRule& rule, int c, const RigidBody& body, const SideFriction& side, double penalty,
                  const ContourFoot& foot, ContactPoint& point, ShearTangent& tangent) {
  const PlanePoint at_old = at_point(rule, c, side.x_old);
  const ContourFoot foot_old = body.closest(side.placement_old, at_old);
  const TouchingTravel travel(foot_old.gap, foot.gap, body.contour().distance(foot_old, foot));
  double shape[max_side_nodes] = {}, slope[max_side_nodes], pore_pressure = 0;
  if (side.pressure_nodes > 0) evaluate_line(side.pressure_nodes, rule.xi[c], shape, slope);
  for (int a = 0; a < side.pressure_nodes; ++a) pore_pressure += shape[a] * side.pressure[a];
  const ShearState& old = side.old[c];
  ShearResponse response = stick_or_slide(side.law, old, side.stiffness, travel.value,
                                          {point.pressure - pore_pressure, at_old, old.slip, side.time});
  if (side.sticks) {
    response = {old, -side.stiffness, 0};
    response.now.shear -= side.stiffness * travel.value;
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
  /// The arm of the moment follows the point and the centre: d(way . force) = turn d(arm) x force.
  void add_arm_change(const ContactRule& rule, int c, const double (&force)[2], int first_body, SideForce& out) const {
    for (int k = 0; k < count; ++k) {
      if (turn[k] == 0) continue;
      const double slope[2] = {turn[k] * force[1], -turn[k] * force[0]};  // by the arm
      for (int j = 0; j < 2; ++j) {
        for (int b = 0; b < rule.nodes; ++b) out.k[first_body + k][2 * b + j] -= slope[j] * rule.shape[c][b];
        for (int b = 0; b < count; ++b) out.k[first_body + k][first_body + b] += slope[j] * shift[b][j];
      }
    }
  }
  int count;
  PlanePoint way[body_directions], shift[body_directions];  // of the point; of the centre
  double turn[body_directions];                             // [1/m] d angle / d unknown
};

}  // namespace

bool penalty_side(const ContactRule& rule, const SideBody& against, double penalty, const SideFriction* friction,
                  const SideCoordinates& x, bool axisymmetric, bool want_tangent, SideForce& out,
                  std::vector<ContactPoint>& points) {
  const RigidBody& body = against.body;
  const int pressures = friction ? friction->pressure_nodes : 0, first_body = 2 * rule.nodes + pressures;
  const int unknowns = body.unknowns().count;
  out = {};
  points.assign(rule.points, {});
  SideAreas areas;
  if (!areas.compute(rule, x, axisymmetric)) return false;
  for (int c = 0; c < rule.points; ++c) {
    const PlanePoint at = at_point(rule, c, x);
    const ContourFoot foot = body.closest(against.placement, at);
    ContactPoint& point = points[c];
    point.gap = foot.gap;
    point.area = areas.area[c];
    point.active = foot.gap < 0;
    point.height = body.height(against.placement, at);
    if (friction) {  // slip and heat stay when the shear stress goes
      point.shear.slip = friction->old[c].slip;
      point.shear.dissipated = friction->old[c].dissipated;
    }
    if (!point.active && !(want_tangent && foot.gap < against.touch)) continue;
    ShearTangent shear;
    if (point.active) {
      point.pressure = -penalty * foot.gap;
      for (int i = 0; i < 2; ++i) point.force[i] = point.pressure * foot.normal[i] * point.area;
      if (friction) add_friction(rule, c, body, *friction, penalty, foot, point, shear);
    }
    const PlanePoint arm{at[0] - against.placement.centre[0], at[1] - against.placement.centre[1]};
    point.moment = arm[0] * point.force[1] - arm[1] * point.force[0];
    for (int i = 0; i < 2; ++i)
      for (int a = 0; a < rule.nodes; ++a) out.f[2 * a + i] += rule.shape[c][a] * point.force[i];
    const BodyWays ways(body.unknowns(), arm);
    for (int k = 0; k < unknowns; ++k) out.f[first_body + k] -= ways.along(k, point.force);
    if (!want_tangent) continue;
    // derivatives of the point's force with respect to each dof, then spread to the nodes and to the body
    double change[2][max_side_dofs] = {};
    for (int i = 0; i < 2; ++i) {
      const double traction = point.pressure * foot.normal[i] + point.shear.shear * foot.tangent[i];
      // d(t n + s m)/dx with dn = turning m (m . dx), dm = -turning n (m . dx)
      const double turned = foot.turning * (point.pressure * foot.tangent[i] - point.shear.shear * foot.normal[i]);
      for (int b = 0; b < rule.nodes; ++b)
        for (int j = 0; j < 2; ++j) {
          const double slope =
              turned * foot.tangent[j] - penalty * foot.normal[i] * foot.normal[j] + foot.tangent[i] * shear.x[j];
          change[i][2 * b + j] = slope * rule.shape[c][b] * point.area + traction * areas.variation[c][2 * b + j];
          // what moves the point one way moves the body the other way
          for (int k = 0; b == 0 && k < unknowns; ++k) change[i][first_body + k] -= slope * ways.way[k][j] * point.area;
        }
      for (int k = 0; k < unknowns; ++k)
        change[i][first_body + k] +=
            ways.turn[k] * (point.pressure * foot.tangent[i] - point.shear.shear * foot.normal[i]) * point.area;
      for (int b = 0; b < pressures; ++b)
        change[i][2 * rule.nodes + b] = foot.tangent[i] * shear.pressure[b] * point.area;
    }
    for (int b = 0; b < first_body + unknowns; ++b) {
      for (int a = 0; a < rule.nodes; ++a)
        for (int i = 0; i < 2; ++i) out.k[2 * a + i][b] += rule.shape[c][a] * change[i][b];
      const double column[2] = {change[0][b], change[1][b]};
      for (int k = 0; k < unknowns; ++k) out.k[first_body + k][b] -= ways.along(k, column);
    }
    ways.add_arm_change(rule, c, point.force, first_body, out);
  }
  return true;
}

}  // namespace mudline
