#pragma once

#include <vector>

#include "bodies/rigid_body.hpp"
#include "contact/body/contact_rule.hpp"
#include "contact/laws/contact_damping.hpp"
#include "contact/laws/impact_share.hpp"
#include "contact/laws/normal_law.hpp"
#include "contact/laws/stick_slip.hpp"

namespace mudline {

/// What happens at one contact point.
struct ContactPoint {
  double gap, pressure;  // [m] negative: penetration; [Pa] >= 0
  double force[2];       // [N] on the soil
  double area;           // [m2]
  bool active;           // presses: gap < shift
  ShearState shear;      // with friction
  double friction[2];    // [N] part of the force that is along the surface
  double height;         // [m] in the body's frame above its reference point
  double moment;         // [N m] of the force about the body's centre
  double damping[2];     // [N] what damping adds to the mean force over the step
  double damped;         // [J] heat that it makes in the step
};

/// Where the body and the side were when the step began.
struct SideStart {
  BodyPlacement placement;
  SideCoordinates x;  // [m]
};

/// What friction on one side depends on.
struct SideFriction {
  const Friction& law;
  double stiffness;                 // [Pa/m] along the surface
  double time, dt;                  // [s] end of the step; its length
  const ShearState* old;            // (point) committed
  bool first_guess;                 // the response is linear: no point changes between sticking and sliding
  int pressure_nodes;               // first nodes of the side that carry pore pressure; 0: none counts
  double pressure[max_side_nodes];  // [Pa] there
};

/// Force [N] on the soil and its moment about the body's centre [N m].
using PointForce = std::array<double, 3>;

/// What acts over a step. By itself the integrator takes (1 - alpha_f) of the force at the end and alpha_f of that at
/// the start.
struct SideStep {
  double alpha_f = 0, dt = 1;          // [-], [s]
  const PointForce* old = nullptr;     // (point) at the start of the step: points exert shares of ImpactShare instead
  double impact_damping = 0;           // [-] of those shares
  double viscous = 0;                  // [s/m] coefficient of ContactDamping; 0: none
  const double* normal_old = nullptr;  // (point) [N] normal force at the start of the step, for ContactDamping
};

/// Which points press. Augmented Lagrangian: the pressure of point c is penalty <shift_c - gap>, shift = multiplier /
/// penalty [m]. Tangential multipliers are part of SideFriction::old.
struct SideShift {
  double now[max_contact_points] = {}, old[max_contact_points] = {};  // (point) in this step; in the committed state
  bool fixed = false;  // member decides, not the gap: t = penalty (shift_c - gap)
  bool member[max_contact_points] = {};
};

/// The body that a side may touch.
struct SideBody {
  const RigidBody& body;
  BodyPlacement placement;
  SideStart start;
  /// [m] Points nearer than this count as pressing in the tangent, not in the force: a body without inertia that
  /// touches nothing yet would have no stiffness at all.
  double touch = 0;
  double touch_share = 1;  // of the penalty that such points have in the tangent
};

/// Dofs of one side in its element matrix: the nodes' displacements, node after node, component after component; then
/// (with friction on the effective traction) the pore pressures of the first nodes; then the body's unknowns.
constexpr int max_side_dofs = 3 * max_side_nodes + body_directions;

/// Forces of one side [N] on the soil and on the body, by dof (none for the pressures), and their derivatives [N/m,
/// m2].
struct SideForce {
  double f[max_side_dofs];           // at the end of the step
  double correction[max_side_dofs];  // to be added at the alpha level, with shares of ImpactShare or ContactDamping
  double k[max_side_dofs][max_side_dofs];  // of f + correction / (1 - alpha_f)
};

/// Normal law t(shift - gap), by itself penalty <shift - gap>, at the contact points of a side against a body:
/// f_a = sum_c shape_ca (t n + s m) A_c with the shear stress s along the contour's direction m; null `friction`: s =
/// 0. The body gets the opposite force and its moment. The tangent is exact: variation of gap, normal (curvature of the
/// body), travel, length and radius of the side, place and rotation of the body. penalty [Pa/m]. `points` receives
/// rule.points results. False for a degenerate side.
bool penalty_side(const ContactRule& rule, const SideBody& against, const NormalLaw& law, double penalty,
                  const SideFriction* friction, const SideStep& step, const SideShift& shift, const SideCoordinates& x,
                  bool axisymmetric, bool want_tangent, SideForce& out, std::vector<ContactPoint>& points);

}  // namespace mudline
