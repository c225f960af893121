#pragma once

#include "contact/contact_rule.hpp"
#include "contact/laws/contact_point.hpp"
#include "tensor/mat.hpp"

namespace mudline {

/// Nodes of a pair's two sides, the slave's first: displacements node after node, component after component.
constexpr int pair_dofs = 4 * max_line_nodes;
/// What the forces depend on: these displacements, and after them the pore pressures of the slave's first nodes.
constexpr int pair_unknowns = pair_dofs + max_line_nodes;
/// Multipliers of a slave side: linear shapes, one at each corner.
constexpr int side_multipliers = 2;

/// Positions of the nodes of two sides [m].
struct PairCoordinates {
  SideCoordinates slave{}, master{};
};

/// Point law and old state between two sides.
struct PairLaw : ContactPointLaw {
  int nodes = 3;  // of either side
  Geometry geometry = Geometry::plane_strain;
  QuadratureRule rule;  // on a segment
  double capture = 0;   // [m] points farther away than this, in front or behind, are not paired
  double normal[side_multipliers] = {}, shear[side_multipliers] = {};  // [Pa] multipliers at the slave's corners
  double pressure_old[side_multipliers] = {};  // [Pa] at the corners at the start of the step, for damping
  double slip_old[side_multipliers] = {};      // [m] path slid so far at the corners; not a number: not read
  TouchingSoil soil[side_multipliers];         // of the slave, at its corners; its pore pressure is added to:
  int pressures = 0;                           // of the slave's first nodes: 2, or all of its nodes; 0: not read
  double pore_pressure[max_line_nodes] = {};   // [Pa] of these nodes, at the end of the step
};

/// Integrals over the segment, weighted by the multipliers' shapes (a) and the length without the circumference [m].
struct PairSums {
  double length[side_multipliers] = {};         // of the segment
  double pressure[side_multipliers] = {};       // [N/m]
  double gap[side_multipliers] = {};            // [m2]
  Mat<double, side_multipliers> touching = {};  // shape times shape where it presses
  double shear[side_multipliers] = {},
         stretch[side_multipliers] = {};  // [N/m]; of shear less multiplier, where it sticks
  double slip[side_multipliers] = {};     // path slid in this step [m2]
  double sliding = 0;                     // length that slides [m]
  double area = 0;                        // pressing area [m2], with the circumference
  double heat = 0;                        // [J] of friction in this step
  double damped = 0;                      // [J] heat of damping in this step
  double deepest = 0;                     // least gap of the points that press [m]
  double closest = 0;                     // least gap [m]
};

/// Forces [N] on the nodes of both sides, and their derivatives [N/m, N/Pa].
struct PairForce {
  double f[pair_dofs];                 // at the end of the step
  double damping[pair_dofs];           // what damping adds to the mean over the step
  double k[pair_dofs][pair_unknowns];  // of f + damping / (1 - start_weight)
  double heat[2][side_multipliers];    // [J] of friction in this step: spread over the slave's corners, the master's
  PairSums sums;
};

/// One side of the slave surface against one of the master surface, both straight or parabolic, by surface quadrature
/// over the segment of the slave side whose points have their closest point on the master side, by the point law:
/// pressure t = <multiplier - penalty gap>, gap along the master's outward normal at the closest point (nearest point);
/// stick spring from the multiplier of shear. Positive shear acts on the slave along the master's direction (outward
/// normal on its right). Slave gets t n + s m, master the opposite at the closest point, so momentum is kept to
/// rounding. The tangent is exact: ends of the segment, closest point, normal, lengths, pore pressure. Returns false
/// where no point of the slave side has its closest point on the master side within `capture`.
bool pair_segment(const PairLaw& law, const PairCoordinates& old, const PairCoordinates& now, bool want_tangent,
                  PairForce& out);

}  // namespace mudline
