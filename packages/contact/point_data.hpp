#pragma once

#include "contact/laws/touching_soil.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// Friction history of a contact point.
struct ShearState {
  /// [Pa] on the slave; 0 where it does not touch. In the plane one number, along the target's direction of travel (its
  /// outward normal on the right); in space a vector.
  Point shear{};
  double slip = 0;        // [m] path that the point has slid so far
  double dissipated = 0;  // [J] heat, over the point's area
  bool slides = false;
};

/// What a contact point brings into a step. Augmented Lagrangian: shift = multiplier / penalty, and tangential
/// multipliers are part of the shear.
struct PointHistory {
  double offset = 0;                // [m] by which the gap that counts is smaller than that of the geometry
  double gap = 0;                   // [m] counted, committed
  double shift = 0, shift_old = 0;  // [m] in this step; in the committed state
  TouchingSoil soil;                // its pore pressure is added to that of the side's nodes
  ShearState shear;                 // committed
  Point force{};                    // [N] on the slave, committed
  double normal_force = 0;          // [N] committed
  double cavitation = 0;            // [Pa] of the film
  double vapour = 0;                // [m] of the film's thickness, committed
};

/// Result of the evaluation of one contact point.
struct ContactPoint {
  double gap, pressure;  // [m] counted, negative: penetration; [Pa] >= 0
  Point force;           // [N] on the slave
  Point normal;          // out of the target
  double area;           // [m2]
  bool active;           // presses: gap < shift
  ShearState shear;      // with friction
  Point friction;        // [N] part of the force that is along the surface
  double height;         // [m] above the reference point of a rigid target, in its frame
  Point moment;          // [N m] of the force about the centre of a rigid target, in the plane about z
  Point damping;         // [N] what damping adds to the mean force over the step
  double damped;         // [J] heat of damping in the step
  double water, vapour;  // [m3]; [m] of the film's thickness
  Point film;            // [N] part of the force that is the film's
};

}  // namespace mudline
