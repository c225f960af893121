#pragma once

#include "contact/laws/contact_point.hpp"
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
struct NodeLaw : ContactPointLaw {
  double area = 0;               // [m2] tributary, at the start of the step
  double normal = 0, shear = 0;  // [Pa] multipliers
  double slip = 0;               // [m] path slid before the step
  double gap_old = 0;            // [m] at the start of the step, for shares and damping
  double normal_old = 0;         // [N] normal force there
  TouchingSoil soil;             // of the slave
};

struct NodeForce {
  double f[node_dofs];             // [N] at the end of the step
  double damping[node_dofs];       // [N] what damping adds to the mean over the step
  double k[node_dofs][node_dofs];  // [N/m] of share * f + damping / the end's weight in the integrator's force
  double share = 1;                // of the end in the mean over the end's weight in the integrator's force
  double start_share = 0;          // of the force at the start in the mean over the step
  double start_share_slope[node_dofs];
  double gap = 0;                  // [m] along the master's normal
  double pressure = 0, shear = 0;  // [Pa] shear: on the slave, along the master's direction of travel
  bool presses = false, slides = false;
  double slip = 0;    // [m] of this step
  double heat = 0;    // [J] of friction in this step
  double damped = 0;  // [J] of damping in this step
};

/// The point law at one slave node against its foot on a piece of the master: pressure t = <multiplier - penalty gap>,
/// stick spring from the multiplier of shear, stretched by the step's relative displacement of the node and of the
/// material point at its foot along the surface. The slave gets (t n + s m) area, the master the opposite at the foot,
/// with its weights: forces cancel to rounding. The tangent is exact; area and weights' coefficients are those of the
/// start of the step.
void node_force(const NodeLaw& law, const SurfacePiece& piece, const NodeFoot& foot, const NodeCoordinates& old,
                const NodeCoordinates& now, bool want_tangent, NodeForce& out);

/// The gap alone [m].
double node_gap(const SurfacePiece& piece, const NodeFoot& foot, const NodeCoordinates& now);

}  // namespace mudline
