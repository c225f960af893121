#pragma once

#include <vector>

#include "bodies/rigid_body.hpp"
#include "contact/contact_rule.hpp"
#include "contact/laws/contact_point.hpp"

namespace mudline {

/// What acts on the soil at a point: force [N] and moment about the body's centre [N m], in the plane about z.
struct PointForce {
  Point force{}, moment{};
};

/// What friction remembers of a contact point.
struct ShearState {
  /// [Pa] on the soil; 0 off the body. In the plane one number, along the contour's direction of travel; in space a
  /// vector.
  Point shear{};
  double slip = 0;        // [m] path that the point has slid, since it was made
  double dissipated = 0;  // [J] heat, over the point's area
  bool slides = false;
};

/// What is known of a contact point before it is evaluated. Augmented Lagrangian: shift = multiplier / penalty, and
/// tangential multipliers are part of the shear.
struct ContactStart {
  double shift = 0, shift_old = 0;  // [m] in this step; in the committed state
  bool member = false;              // of the active set
  TouchingSoil soil;                // its pore pressure is that beside what the side's nodes have
  ShearState shear;                 // committed
  PointForce force;                 // committed
  double normal_force = 0;          // [N] committed
};

/// What happens at one contact point.
struct ContactPoint {
  double gap, pressure;  // [m] negative: penetration; [Pa] >= 0
  PointForce total;      // on the soil
  double area;           // [m2]
  bool active;           // presses: gap < shift
  ShearState shear;      // with friction
  Point friction;        // [N] part of the force that is along the surface
  double height;         // [m] in the body's frame above its reference point
  Point damping;         // [N] what damping adds to the mean force over the step
  double damped;         // [J] heat that it makes in the step
};

/// One side of the soil's surface against a body, at both ends of a step.
struct SideContact {
  const ContactRule& rule;
  const RigidBody& body;
  BodyPlacement placement_old, placement;
  SideCoordinates x_old, x;  // [m]
  Geometry geometry;
  ContactPointLaw law;
  /// [m] Points nearer than this count as pressing in the tangent, not in the force: a body without inertia that
  /// touches nothing yet would have no stiffness at all.
  double reach = 0;
  double reach_share = 1;                       // of the penalty that such points have in the tangent
  int pressure_nodes = 0;                       // first nodes of the side that carry pore pressure; 0: none counts
  double pressure[max_side_nodes] = {};         // [Pa] there
  ContactStart start[max_contact_points] = {};  // (point)
};

/// Forces of one side [N] on the soil and on the body, and their derivatives [N/m, m2]. Dofs: the nodes' displacements,
/// node after node, component after component; then (with laws that read them) the pore pressures of the first nodes,
/// which have no force; then the body's unknowns.
struct SideForce {
  int dofs = 0;
  std::vector<double> f;           // at the end of the step
  std::vector<double> correction;  // to be added at the alpha level: shares of impacts, damping
  std::vector<double> k;           // (dof, dof) of f + correction / (1 - start_weight)
};

/// The point law at the contact points of a side: f_a = sum_c shape_ca (t n + s) A_c with the pressure t, the normal n
/// from the body into the soil and the shear stress s along the surface. The body gets the opposite force and its
/// moment. The tangent is exact: variation of gap, normal (curvature of the body), travel, area and radius of the side,
/// place and rotation of the body. `points` receives rule.points results. False for a degenerate side.
bool penalty_side(const SideContact& side, bool want_tangent, SideForce& out, std::vector<ContactPoint>& points);

}  // namespace mudline
