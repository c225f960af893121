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
  const ContourFoot foot_old = body.closest(side.position_old, at_old);
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

}  // namespace

bool penalty_side(const ContactRule& rule, const RigidBody& body, const std::array<double, 2>& position, double penalty,
                  const SideFriction* friction, const SideCoordinates& x, bool axisymmetric, bool want_tangent,
                  SideForce& out, std::vector<ContactPoint>& points) {
  out = {};
  points.assign(rule.points, {});
  SideAreas areas;
  if (!areas.compute(rule, x, axisymmetric)) return false;
  for (int c = 0; c < rule.points; ++c) {
    const ContourFoot foot = body.closest(position, at_point(rule, c, x));
    ContactPoint& point = points[c];
    point.gap = foot.gap;
    point.area = areas.area[c];
    point.active = foot.gap < 0;
    if (friction) {  // slip and heat stay when the shear stress goes
      point.shear.slip = friction->old[c].slip;
      point.shear.dissipated = friction->old[c].dissipated;
    }
    if (!point.active) continue;
    point.pressure = -penalty * foot.gap;
    for (int i = 0; i < 2; ++i) point.force[i] = point.pressure * foot.normal[i] * point.area;
    ShearTangent shear;
    if (friction) add_friction(rule, c, body, *friction, penalty, foot, point, shear);
    for (int i = 0; i < 2; ++i)
      for (int a = 0; a < rule.nodes; ++a) out.f[2 * a + i] += rule.shape[c][a] * point.force[i];
    if (!want_tangent) continue;
    for (int i = 0; i < 2; ++i) {
      const double traction = point.pressure * foot.normal[i] + point.shear.shear * foot.tangent[i];
      // d(t n + s m)/dx with dn = turning m (m . dx), dm = -turning n (m . dx)
      const double turned = foot.turning * (point.pressure * foot.tangent[i] - point.shear.shear * foot.normal[i]);
      for (int b = 0; b < rule.nodes; ++b)
        for (int j = 0; j < 2; ++j) {
          const double slope =
              turned * foot.tangent[j] - penalty * foot.normal[i] * foot.normal[j] + foot.tangent[i] * shear.x[j];
          const double change = slope * rule.shape[c][b] * point.area + traction * areas.variation[c][2 * b + j];
          for (int a = 0; a < rule.nodes; ++a) out.k[2 * a + i][2 * b + j] += rule.shape[c][a] * change;
        }
      for (int b = 0; friction && b < friction->pressure_nodes; ++b)
        for (int a = 0; a < rule.nodes; ++a)
          out.k[2 * a + i][2 * rule.nodes + b] += rule.shape[c][a] * foot.tangent[i] * shear.pressure[b] * point.area;
    }
  }
  return true;
}

}  // namespace mudline
