#pragma once

#include <array>
#include <vector>

#include "contact/stick_slip.hpp"
#include "physics/rigid_body/rigid_body.hpp"

namespace mudline {

/// Where contact is checked on a side.
enum class ContactPoints { quadrature, nodes };

constexpr int max_side_nodes = 3;

/// Coordinates of the nodes of one side [m]: two corners, then the middle of a quadratic side.
using SideCoordinates = std::array<PlanePoint, max_side_nodes>;

/// Contact points on a side of 2 or 3 nodes and their areas. Point c lies at sum_a shape[c][a] X_a, spreads its force
/// to the nodes by the same shape, and has the area A_c = sum_q weight[c][q] |x'(q)| (2 pi r(q)) over Gauss points q.
/// Surface quadrature: the points are the Gauss points. Nodes: shape is the identity and A_c = int N_c ds, the
/// tributary area.
struct ContactRule {
  ContactRule(ContactPoints kind, int nodes, int degree);
  int nodes, points, samples;
  std::vector<std::array<double, max_side_nodes>> shape;  // (point, node)
  std::vector<double> xi;                                 // (point) reference coordinate in [-1, 1]
  std::vector<std::vector<double>> weight;                // (point, sample)
  std::vector<std::array<double, max_side_nodes>> N, dN;  // (sample, node)
};

/// Current areas of the contact points of a side [m2], in plane strain per metre of depth, and their derivatives with
/// respect to the nodes' coordinates. False when the side is degenerate: no length, or r < 0.
struct SideAreas {
  bool compute(const ContactRule& rule, const SideCoordinates& x, bool axisymmetric);
  std::vector<double> area;                                       // (point)
  std::vector<std::array<double, 2 * max_side_nodes>> variation;  // (point, dof) [m]
};

/// What happens at one contact point.
struct ContactPoint {
  double gap, pressure;  // [m] negative: penetration; [Pa] >= 0
  double force[2];       // [N] on the soil
  double area;           // [m2]
  bool active;           // gap < 0
  ShearState shear;      // with friction
  double friction[2];    // [N] part of the force that is along the surface
  double height;         // [m] in the body's frame above its reference point
  double moment;         // [N m] of the force about the body's centre
};

/// What friction on one side depends on.
struct SideFriction {
  const Friction& law;
  double stiffness;                    // [Pa/m] along the surface
  double time;                         // [s] end of the step
  BodyPlacement placement_old;         // of the body
  SideCoordinates x_old;               // [m]
  const ShearState* old;               // (point) committed
  bool sticks;                         // whatever the strength: for a first guess
  int pressure_nodes;                  // first nodes of the side that carry pore pressure; 0: none counts
  double pressure[max_side_nodes];     // [Pa] there
};

/// Dofs of one side in its element matrix: the nodes' displacements, node after node, component after component; then
/// (with friction on the effective traction) the pore pressures of the first nodes; then the body's unknowns.
constexpr int max_side_dofs = 3 * max_side_nodes + body_directions;

/// Forces of one side [N] on the soil and on the body, by dof (none for the pressures), and their derivatives [N/m, m2].
struct SideForce {
  double f[max_side_dofs];
  double k[max_side_dofs][max_side_dofs];
};

/// Where the body is and how far the tangent looks.
struct SideBody {
  const RigidBody& body;
  BodyPlacement placement;
  /// [m] Points nearer than this count as pressing in the tangent, not in the force: a body without inertia that
  /// touches nothing yet would have no stiffness at all.
  double touch = 0;
};

/// Penalty law t = penalty <-gap> at the contact points of a side against a body:
/// f_a = sum_c shape_ca (t n + s m) A_c with the shear stress s along the contour's direction m; null `friction`: s = 0.
/// The body gets the opposite force and its moment. The tangent is exact: variation of gap, normal (curvature of the
/// body), travel, length and radius of the side, place and rotation of the body. penalty [Pa/m]. `points` receives rule.points results. False for a degenerate side.
bool penalty_side(const ContactRule& rule, const SideBody& against, double penalty,
                  const SideFriction* friction, const SideCoordinates& x, bool axisymmetric, bool want_tangent,
                  SideForce& out, std::vector<ContactPoint>& points);

}  // namespace mudline
