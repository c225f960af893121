#pragma once

#include "contact/laws/friction.hpp"
#include "contact/nodes/surface_piece.hpp"

namespace mudline {

/// A slave node and the nodes of a piece of the master surface: displacements, the slave's first.
constexpr int node_dofs = 2 + 2 * max_piece_nodes;

/// Where they are [m].
struct NodeCoordinates {
  PlanePoint slave{};
  PieceCoordinates master{};
};

/// What a node sees of the master surface.
struct NodeFoot {
  double eta = 0;
  bool corner = false;   // the nearest point is a corner, at an end of the piece
  PlanePoint outward{};  // at a corner: mean of the unit normals on both sides
};

/// What acts between a slave node and the master.
struct NodeLaw {
  double penalty = 0;                  // [Pa/m]
  double area = 0;                     // [m2] tributary, at the start of the step
  double touch = 0;                    // [m] gap up to which there is stiffness, if no force
  double normal = 0, shear = 0;        // [Pa] multipliers
  const Friction* friction = nullptr;  // null: smooth
  double time = 0, dt = 1;             // [s] end of the step; its length
  double slip = 0;                     // [m] path slid before the step
  bool first_guess = false;            // friction sticks
  bool fixed = false, member = false;  // membership of an active set decides whether the node presses, not its gap
  double end_weight = 0;  // dynamic steps that conserve energy: weight of the end in the integrator's force; 0: others
  double gap_old = 0, damping = 0;  // [m]; see ImpactShare
  double viscous = 0;               // [s/m] coefficient of ContactDamping; 0: none
  double start_weight = 0;          // weight of the start in the integrator's force
  double normal_old = 0;            // [N] normal force at the start of the step
};

struct NodeForce {
  double f[node_dofs];             // [N] at the end of the step
  double damping[node_dofs];       // [N] what damping adds to the mean over the step
  double k[node_dofs][node_dofs];  // [N/m] of share * f + damping / the end's weight in the integrator's force
  double share = 1;  // share of ImpactShare over the end's weight in the integrator's force; 1 where nothing is shared
  double gap = 0;    // [m] along the master's normal
  double gap_slope[node_dofs];     // d gap
  double pressure = 0, shear = 0;  // [Pa] shear: on the slave, along the master's direction of travel
  bool presses = false, slides = false;
  double slip = 0;    // [m] of this step
  double damped = 0;  // [J] heat of damping in this step
};

/// One slave node against its foot on a piece of the master: pressure t = <multiplier - penalty gap>, shear stress by
/// `friction`, stick spring from the multiplier of shear, stretched by the step's relative displacement of the node and
/// of the material point at its foot along the surface. The slave gets (t n + s m) area, the master the opposite at the
/// foot, with its weights: forces cancel to rounding. The tangent is exact; area and weights' coefficients are those of
/// the start of the step.
void node_force(const NodeLaw& law, const SurfacePiece& piece, const NodeFoot& foot, const NodeCoordinates& old,
                const NodeCoordinates& now, bool want_tangent, NodeForce& out);

}  // namespace mudline
