#pragma once

#include "bodies/body_numbers.hpp"
#include "bodies/contour_volume.hpp"
#include "core/parameters.hpp"
#include "tensor/mat.hpp"

namespace mudline {

/// Number of a body's directions of motion: the axes, then the rotations. In the plane they are x, y, rotation
/// (counter-clockwise); in space x, y, z, and the rotations about the body's own axes, which start along the world axes
/// where the body has no 'rotation'.
inline int num_directions(Geometry geometry) { return dimension(geometry) == 2 ? 3 : 6; }
/// Name of a direction in decks.
const char* direction_name(int dimension, int direction);
/// The axis about which it turns: z in the plane.
inline int axis_of_rotation(int dimension, int direction) { return dimension == 2 ? 2 : direction - dimension; }
/// Whether a body may move in this direction: in axisymmetry only along its axis.
inline bool may_move(Geometry geometry, int direction) { return geometry != Geometry::axisymmetric || direction == 1; }

/// Properties on which the loads on a body depend, besides its motion. In axisymmetry they are of the whole body; in
/// plane strain per metre of depth, and of the modelled half where the contour is a half one.
struct BodyProperties {
  double mass = 0;               // [kg]
  double moment_of_inertia = 0;  // [kg m2] in the plane, about the centre of mass
  Mat<double, 3> inertia = {};   // [kg m2] in space, about the centre of mass, along the body's axes
  double volume = 0;             // [m3]; 0: unknown
  Geometry geometry = Geometry::plane_strain;
  const ContourVolume* enclosed = nullptr;  // in the plane
  Point centre{};                           // [m] centre of mass, in the body frame
  Point middle{};           // [m] from the centre of mass to the centre of volume; 0 where that is unknown
  double frontal_area = 0;  // [m2] in the plane: largest section across the vertical, at the start
  bool turned = false;      // it is rotated at the start
  Point frontal_areas{};    // [m2] in space: area of the surface's shadow along each of the body's axes; 0: unknown
};

/// Position and motion of a body when its loads are evaluated.
struct BodyInstant {
  double time = 0;
  BodyVector position = BodyVector::zero();  // [m] of the reference point
  BodyVector velocity = BodyVector::zero();  // [m/s] of the centre of mass
  BodyVector spin = BodyVector::zero();      // [rad/s] about the body's axes
  BodyAxes axes;
};

/// Force [N] and moment about the centre of mass [N m] on a body, in the world frame.
struct BodyLoad {
  BodyVector force = BodyVector::zero(), moment = BodyVector::zero();
  /// Adds a force at a point of the body; `arm`: from the centre of mass to the point, in the world frame [m].
  void add(const BodyVector& more, const BodyVector& arm) {
    force = force + more;
    moment = moment + cross(arm, more);
  }
};

/// Component of a load in a direction, in the world frame.
inline const BodyNumber& along(const BodyLoad& load, int dimension, int direction) {
  return direction < dimension ? load.force[direction] : load.moment[axis_of_rotation(dimension, direction)];
}

/// Value of f at a time and a place, with its derivatives.
BodyNumber at(const Function& f, double time, const BodyVector& x, int dimension);

/// Added mass of the water that moves with a body, along the body's axes.
struct AddedMass {
  Point mass{}, inertia{};  // [kg]; [kg m2], in space
};

/// A force that acts at a point of the body, from a line at a padeye, say.
struct PointLoad {
  void parameters(Parameters& p);
  Point point{};  // [m] in the body frame
  Function force[3], moment[3];
  bool turns = false;  // whether the axes of force and moment turn with the body
};

}  // namespace mudline
